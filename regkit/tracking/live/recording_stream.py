"""A dataset's recording as a stream."""

from __future__ import annotations

from collections.abc import Iterator

from regkit.interfaces import Recording, Stream, TimedFrame
from regkit.observation import Frame


class RecordingStream(Stream):
    """The frames of a recording, at its rate.

    Args:
        recording: The recording.
    """

    def __init__(self, recording: Recording) -> None:
        self.name, self.fps, self.length = recording.name, recording.fps, recording.length
        self._recording = recording
        self._frames: Iterator[Frame] | None = None
        self._next = 0

    def read(self) -> TimedFrame | None:
        """Returns the next frame; None at the end.

        Raises:
            DataError: If the frame is damaged.
        """
        index, self._next = self._next, self._next + 1
        if index >= self._recording.length:
            return None
        if self._frames is None:
            self._frames = (frame for _, frame in self._recording.some(range(index, self._length)))
        try:
            frame = next(self._frames, None)
        except Exception:
            # An iterator that raised has ended; the next call begins a new one behind the frame.
            self._frames = None
            raise
        return None if frame is None else TimedFrame(frame, index / self.fps)

    @property
    def _length(self) -> int:
        return self._recording.length
