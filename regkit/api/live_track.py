"""A stream that is being tracked, for programs: poses as they come."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from regkit.api.live_pose import LivePose
from regkit.api.tracking import Tracking
from regkit.body import Body
from regkit.interfaces import Registrar, Start, Stream
from regkit.system.closing import Closing
from regkit.system.errors import NoDataError
from regkit.system.optional import one_thread
from regkit.tracking.live import LiveTracking


class LiveTrack(Closing):
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

    def begin(self) -> Start:
        """Waits until a body is in sight; returns the pose and size with which the track begins.

        Raises:
            RegkitError: If the stream ends before a body comes into sight.
        """
        with one_thread():
            return self._live.start

    @property
    def body(self) -> Body:
        """The body at its given or estimated size."""
        return self.begin().body

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
