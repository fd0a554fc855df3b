"""Tracking of a camera or a recording as its frames come."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Self

from regkit.api.choices import Choice, Choices
from regkit.api.pipeline import Beginning, Pipeline
from regkit.api.tracking import Tracking
from regkit.body import Body
from regkit.interfaces import (
    Method,
    Preprocessor,
    Registrar,
    Segmenter,
    Source,
    Start,
    Stream,
    Template,
    TimedFrame,
    Tracker,
)
from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.brief import Brief
from regkit.system.errors import ConfigError, NoDataError
from regkit.system.optional import one_thread
from regkit.tracking import Verdict
from regkit.tracking.live import LiveFrame, LiveSetup, LiveTracking
from regkit.tracking.rows import Rows


@dataclass(frozen=True)
class LivePose(Brief):
    """The body in one frame of a stream.

    Attributes:
        number: Number of the frame in the stream, from 0; dropped frames count too.
        time: Its time on the stream's clock [s].
        pose: The pose.
        segments: T_camera_segment of each of S segments, (S, 4, 4) [m].
        markers: The markers in the camera's frame, (M, 3) [m].
        supports: How well data support each segment, (S,), from 0 to 1; NaN for one without
            capsules.
        verdict: Whether the body was found.
        inlier_share: Fraction of the points that lie on the body; NaN without data.
        observation: The data of the frame; None if it has none.
        latency: Time from the frame's arrival to its pose [s].
        seconds: Time to preprocess and register [s].
    """

    number: int
    time: float
    pose: Pose
    segments: Array
    markers: Array
    supports: Array
    verdict: Verdict
    inlier_share: float
    observation: Observation | None
    latency: float
    seconds: float

    @classmethod
    def of(cls, frame: LiveFrame) -> Self:
        """Returns the pose of a tracked frame."""
        tracked, recorded = frame.tracked, frame.recorded
        return cls(
            number=frame.number,
            time=frame.time,
            pose=tracked.registered.pose,
            segments=recorded.placement.transforms,
            markers=recorded.markers,
            supports=recorded.supports,
            verdict=recorded.verdict,
            inlier_share=recorded.fit.inlier_share,
            observation=tracked.observation,
            latency=frame.latency,
            seconds=tracked.seconds,
        )


class LiveTrack:
    """A stream that is being tracked: iterate over it for the poses, as they come.

    A context manager that closes the stream.
    """

    def __init__(self, live: LiveTracking, method: str) -> None:
        self._live = live
        self._method = method

    def __iter__(self) -> Iterator[LivePose]:
        """Yields the pose in each frame.

        Raises:
            RegkitError: If no body comes into sight before the stream ends, or it is lost.
        """
        # A loop that is left early closes the stream too.
        with one_thread(), self:
            for frame in self._live.frames():
                yield LivePose.of(frame)

    @property
    def name(self) -> str:
        """Name of the recording or the camera."""
        return self._live.stream.name

    @property
    def stream(self) -> Stream:
        """The stream."""
        return self._live.stream

    @property
    def start(self) -> Start:
        """The pose and size with which the tracking began, sought when they are first needed.

        Raises:
            RegkitError: If the stream ends before a body comes into sight.
        """
        with one_thread():
            return self._live.start

    @property
    def body(self) -> Body:
        """The body at its given or estimated size."""
        return self.start.body

    @property
    def registrar(self) -> Registrar:
        """The registrar of the frames."""
        return self._live.recorder.registrar

    @property
    def is_live(self) -> bool:
        """Whether frames come at their own pace, and those that are late are dropped."""
        return self._live.is_live

    @property
    def is_begun(self) -> bool:
        """Whether a body has come into sight."""
        return self._live.is_begun

    @property
    def dropped(self) -> int:
        """Number of frames that were not tracked because newer ones had arrived."""
        return self._live.dropped

    @property
    def faults(self) -> Counter[str]:
        """Numbers of faults of the stream, such as ``repeated`` or ``damaged`` frames."""
        return self._live.watch.faults

    def latency(self, quantile: float = 0.5) -> float:
        """Returns the time [s] from a frame's arrival to its pose, at a quantile of all frames."""
        return self._live.latencies[quantile]

    def tracking(self) -> Tracking:
        """Returns everything that was tracked so far.

        Raises:
            RegkitError: If no body has come into sight, or no frame has been tracked.
        """
        live = self._live
        stream = live.stream
        if not len(live.recorder):
            raise NoDataError(
                "no frame has been tracked yet; iterate over the track first", place=stream.name
            )
        return Tracking.of(stream.name, self._method, stream.fps, live.start, live.recorder)

    def close(self) -> None:
        """Closes the stream."""
        self._live.close()

    def __enter__(self) -> Self:
        """Returns the track."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Closes the stream."""
        self.close()


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
