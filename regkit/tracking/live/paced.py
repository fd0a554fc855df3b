"""A recording that is played at its own pace, as a camera would measure it."""

from __future__ import annotations

import time

from regkit.interfaces import Stream, TimedFrame

LONGEST_PAUSE = 10.0
"""A gap between two time stamps is played for at most this time [s]."""


class PacedStream(Stream):
    """A recording as a live stream: each frame comes when its time has come.

    Args:
        recording: The recording, which is closed with this stream.
    """

    live = True

    def __init__(self, recording: Stream) -> None:
        self.name, self.fps = recording.name, recording.fps
        self.length, self.depth_scale = recording.length, recording.depth_scale
        self._recording = recording
        self._due: float | None = None
        self._last = 0.0

    def read(self) -> TimedFrame | None:
        """Returns the next frame when its time has come; None at the end.

        Raises:
            DataError: If the frame is damaged.
            SourceLostError: If the recording yields no further frame.
        """
        frame = self._recording.read()
        if frame is None:
            return None
        now = time.perf_counter()
        pause = 0.0 if self._due is None else frame.time - self._last
        self._due = (now if self._due is None else self._due) + min(max(pause, 0.0), LONGEST_PAUSE)
        self._last = frame.time
        time.sleep(max(self._due - now, 0.0))
        return frame

    def close(self) -> None:
        """Closes the recording."""
        self._recording.close()
