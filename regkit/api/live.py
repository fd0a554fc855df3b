"""Tracking of a camera or a recording as its frames come."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from regkit.api.choices import Choice, Choices
from regkit.api.live_track import LiveTrack
from regkit.api.pipeline import Beginning, Pipeline
from regkit.interfaces import (
    Method,
    Preprocessor,
    Segmenter,
    Source,
    Start,
    Stream,
    Template,
    TimedFrame,
    Tracker,
)
from regkit.system.errors import ConfigError
from regkit.tracking.live import LiveSetup, LiveTracking
from regkit.tracking.rows import Rows


def track_live(
    source: str | Path | Source,
    template: Choice[Template],
    method: Choice[Method] | None = None,
    *,
    segmentation: Choices[Segmenter] | None = None,
    preprocessor: Choice[Preprocessor] | None = None,
    tracker: Choice[Tracker] | None = None,
    start: Beginning | None = None,
    opening: float | None = None,
    every_frame: bool = False,
    realtime: bool = False,
) -> LiveTrack:
    """Tracks a body as the frames of a camera or a recording come.

    The body, its size and its surroundings are sought in the first seconds. Of a camera the newest
    frame is tracked, and older ones that wait are dropped.

    Args:
        source: A camera such as ``"realsense:"``, the file or folder of a recording, or a source.
        template: As in ``track``.
        method: As in ``track``.
        segmentation: As in ``track``.
        preprocessor: As in ``track``.
        tracker: As in ``track``.
        start: As in ``track``.
        opening: Duration in which the body, its size and its surroundings are sought [s]; by
            default that of a camera is short, and that of a recording longer.
        every_frame: Whether to track every frame of a camera, however late.
        realtime: Whether to play a recording at its own pace, as a camera.

    Returns:
        The poses, to iterate over.

    Raises:
        RegkitError: If an argument is invalid, or the source cannot be opened.
    """
    place = "regkit.track_live"
    pipeline = Pipeline.of(
        template, method, segmentation, preprocessor, tracker, start, place=place
    )
    opened = source if isinstance(source, Source) else Source.at(source)
    return live_track(
        opened.open, pipeline, opening=opening, every_frame=every_frame, realtime=realtime
    )


def live_track(
    source: Callable[[], Stream],
    pipeline: Pipeline,
    *,
    opening: float | None = None,
    every_frame: bool = False,
    realtime: bool = False,
    rows: Callable[[Start], Rows] | None = None,
    tap: Callable[[TimedFrame], None] | None = None,
    check: Callable[[], None] | None = None,
) -> LiveTrack:
    """Tracks a body as the frames of a stream come; as ``track_live``.

    Args:
        source: Opens the stream.
        pipeline: What tracks the body.
        opening: As in ``track_live``.
        every_frame: As in ``track_live``.
        realtime: As in ``track_live``.
        rows: Returns where the values of the track are kept; in memory by default.
        tap: Called with every frame of the track when it is read, in another thread.
        check: Called between two frames; what it raises ends the tracking.

    Raises:
        RegkitError: If the source cannot be opened.
    """
    if opening is not None and not 0.0 < opening <= 3600.0:
        raise ConfigError(f"{opening:g} s; it must be positive, and at most an hour",
                          place="opening")  # fmt: skip
    setup = LiveSetup(
        session=pipeline.session,
        bind=pipeline.method.bind,
        tracker=pipeline.tracker,
        rows=rows,
        opening=opening,
        every_frame=every_frame,
        realtime=realtime,
        tap=tap,
        check=check or (lambda: None),
    )
    return LiveTrack(LiveTracking(source, setup), pipeline.method_name)
