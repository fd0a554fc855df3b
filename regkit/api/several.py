"""Tracking of several bodies in one recording, each by itself."""

from __future__ import annotations

from dataclasses import replace

from regkit.api.choices import Choice, Choices, load_template, segmenters_of
from regkit.api.frame import Intrinsics
from regkit.api.pipeline import Pipeline
from regkit.api.recordings import Frames, recording_of
from regkit.api.running import tracked_through
from regkit.api.tracking import Tracking
from regkit.interfaces import (
    Method,
    Preprocessor,
    Segmenter,
    StartSearch,
    Template,
    Tracker,
    each_body,
)
from regkit.system.errors import ConfigError


def track_each(
    frames: Frames,
    template: Choice[Template],
    method: Choice[Method] | None = None,
    *,
    camera: Intrinsics | None = None,
    fps: float = 30.0,
    segmentation: Choices[Segmenter] | None = None,
    preprocessor: Choice[Preprocessor] | None = None,
    tracker: Choice[Tracker] | None = None,
    start: Choice[StartSearch] | None = None,
) -> tuple[Tracking, ...]:
    """Tracks every body that the segmentation tells apart in the first frame, each by itself.

    The bodies do not know of each other: where one hides another, both may be found in the same
    place. Who enters later is not tracked.

    Args:
        frames: As in ``track``.
        template: Template of all bodies; an unknown size is estimated for each.
        method: As in ``track``.
        camera: As in ``track``.
        fps: As in ``track``.
        segmentation: As in ``track``; ``pieces`` and ``room`` tell bodies apart.
        preprocessor: As in ``track``.
        tracker: As in ``track``.
        start: Search for pose and size of each body, as in ``track``; a given pose is that of one.

    Returns:
        A track for each body from the nearest to the farthest, named RECORDING-1, RECORDING-2, ...;
        one with the recording's name if there is one body.

    Raises:
        RegkitError: As in ``track``.
    """
    place = "regkit.track_each"
    recording, loaded = recording_of(frames, camera, fps), load_template(template)
    start = StartSearch.default() if start is None else start
    search = StartSearch.parse(start, place=place, field="start")
    if not search.searches:
        raise ConfigError("a given start is that of one body; use a search", place="start")
    recording.prepare()
    each = each_body(segmenters_of(segmentation, place=place), recording, loaded)
    # In a later frame the piece of the same number may be another's.
    sized_in = 3 if len(each) == 1 else 1
    pipelines = [
        Pipeline.of(loaded, method, one, preprocessor, tracker, search, place=place) for one in each
    ]
    tracks = [tracked_through(recording, one, sized_in=sized_in) for one in pipelines]
    if len(tracks) == 1:
        return tuple(tracks)
    return tuple(
        replace(track, name=f"{track.name}-{number}") for number, track in enumerate(tracks, 1)
    )
