"""The first frames of a stream."""

from __future__ import annotations

from regkit.interfaces import Stream, TimedFrame


class LimitedStream(Stream):
    """A stream that ends after a number of frames.

    Args:
        whole: The stream, which is closed with this one.
        count: Largest number of frames.
    """

    def __init__(self, whole: Stream, count: int) -> None:
        self.name, self.fps, self.live = whole.name, whole.fps, whole.live
        self.depth_scale = whole.depth_scale
        self.length = count if whole.length is None else min(count, whole.length)
        self._whole = whole
        self._left = count

    def read(self) -> TimedFrame | None:
        """Returns the next frame; None after the last one.

        Raises:
            DataError: If the frame is damaged.
            SourceLostError: If the stream yields no further frame.
        """
        if not self._left:
            return None
        self._left -= 1
        frame = self._whole.read()
        self.dropped = self._whole.dropped
        return frame

    def close(self) -> None:
        """Closes the stream."""
        self._whole.close()
