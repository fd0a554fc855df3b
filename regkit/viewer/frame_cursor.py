"""Frames of a recording by their index, read one after the other where possible."""

from __future__ import annotations

from collections.abc import Iterator

from regkit.interfaces import Recording
from regkit.observation import Frame

AHEAD = 30
"""A frame that is at most so many frames later is read by reading on."""


class FrameCursor:
    """Reads the frames of a recording; a file that is read from its beginning only is read on.

    Args:
        recording: The recording.
    """

    def __init__(self, recording: Recording) -> None:
        self._recording = recording
        self._frames: Iterator[tuple[int, Frame]] = iter(())
        self._last: int | None = None

    def at(self, index: int) -> Frame | None:
        """Returns a frame; None if the recording ends before.

        Raises:
            RegkitError: If the frame cannot be read.
        """
        if self._last is None or not self._last < index <= self._last + AHEAD:
            self._frames = self._recording.some(range(index, self._recording.length))
        for number, frame in self._frames:
            if number == index:
                self._last = index
                return frame
        return None
