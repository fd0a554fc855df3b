"""Streams: open sources."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator

from regkit.observation import TimedFrame
from regkit.system.closing import Closing


class Stream(Closing):
    """An open source; a context manager that closes it.

    Attributes:
        name: Name of the recording or camera, for messages and folders.
        fps: Nominal frame rate [1/s].
        length: Number of frames; None if it is unknown or there is no end.
        live: Whether the frames are measured while they are read. A live stream cannot be opened
            again at its beginning, and what is not read in time is lost.
        depth_scale: Units of the original depth images per metre, such as 1000 for millimetres; a
            recording with this scale keeps every depth exactly.
        dropped: Number of frames that are known to be lost since the stream was opened.
    """

    name: str
    fps: float
    length: int | None = None
    live: bool = False
    depth_scale: float = 1000.0
    dropped: int = 0

    @abstractmethod
    def read(self) -> TimedFrame | None:
        """Returns the next frame, waiting for it if need be; None at the end, and ever after.

        Raises:
            DataError: If this frame is damaged; the next call reads the frame after it.
            SourceLostError: If the source yields no further frame although it has not ended, such
                as an unplugged camera.
        """

    def __iter__(self) -> Iterator[TimedFrame]:
        """Yields the frames that are left; errors are those of ``read``."""
        while (timed := self.read()) is not None:
            yield timed

    def close(self) -> None:
        """Releases the file or device; calling it again does nothing."""
