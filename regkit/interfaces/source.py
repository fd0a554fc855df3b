"""Sources: cameras and recordings that yield frames with their time, finite or not."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, ClassVar, Self

from regkit.config.plugin import Plugin
from regkit.observation import Frame
from regkit.system.brief import Brief


@dataclass(frozen=True)
class TimedFrame(Brief):
    """A frame with the time of its measurement.

    Attributes:
        frame: The frame; its camera is a pinhole camera, and its depth is rectified.
        time: Time of the measurement on the source's own clock [s].
    """

    frame: Frame
    time: float


class Stream(ABC):
    """An open source; a context manager that closes it.

    Attributes:
        name: Name of the recording or camera, for messages and folders.
        fps: Nominal frame rate [1/s].
        length: Number of frames; None if it is unknown or there is no end.
        live: Whether the frames are measured while they are read. A live stream cannot be opened
            again at its beginning, and what is not read in time is lost.
        depth_scale: Units of the original depth images per metre, such as 1000 for millimetres; a
            recording with this scale keeps every depth exactly.
    """

    name: str
    fps: float
    length: int | None = None
    live: bool = False
    depth_scale: float = 1000.0

    @abstractmethod
    def read(self) -> TimedFrame | None:
        """Returns the next frame, waiting for it if need be; None at the end.

        Raises:
            DataError: If this frame is damaged; the next call reads the frame after it.
            SourceLostError: If the source yields no further frame although it has not ended, such
                as an unplugged camera.
        """

    def close(self) -> None:
        """Releases the file or device; calling it again does nothing."""

    def __enter__(self) -> Self:
        """Returns the stream."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Closes the stream."""
        self.close()


class Source(Plugin, ABC):
    """A camera or a recording, found by its address: a scheme, or the suffix of a file.

    ``realsense:0123`` is the camera of a serial number, as the plug-in with the scheme
    ``realsense`` opens it; ``walk.mcap`` is a file whose suffix a plug-in lists and which it
    accepts.
    """

    group = "regkit.sources"

    scheme: ClassVar[str] = ""
    """Begin of an address without its colon; empty for files and folders."""
    suffixes: ClassVar[tuple[str, ...]] = ()
    """Suffixes of the files that the plug-in reads, in lower case with their dot."""

    @classmethod
    def accepts(cls, path: Path) -> bool:
        """Returns whether a file or folder is of this plug-in's format.

        Several plug-ins may list a suffix, so those whose format shares it look into the file. The
        default accepts every file with a suffix of the plug-in.
        """
        return path.is_file() and path.suffix.lower() in cls.suffixes

    @classmethod
    def fields_of(cls, address: str) -> dict[str, Any]:
        """Returns the fields that an address stands for; the default is its path.

        Args:
            address: The path of a file or folder, or what follows the scheme and its colon.
        """
        return {"path": address}

    @abstractmethod
    def open(self) -> Stream:
        """Opens the source at its first frame.

        Raises:
            RegkitError: If it does not exist, cannot be read, or needs a missing library.
        """
