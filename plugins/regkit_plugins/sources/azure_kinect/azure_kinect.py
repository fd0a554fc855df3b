"""The source of recordings of Azure Kinect."""

from __future__ import annotations

from pathlib import Path
from typing import BinaryIO, ClassVar, Literal

from regkit.config.model import InputPath
from regkit.geometry import Lens
from regkit.interfaces import Source, Stream, TimedFrame
from regkit.observation import Frame
from regkit.system.errors import DataError, SourceLostError
from regkit.system.guard import foreign, reading
from regkit_plugins.sources.azure_kinect.calibration import lens_of
from regkit_plugins.sources.azure_kinect.track import DepthTrack
from regkit_plugins.sources.formats.clock import checked_time

MARKS = (b"K4A_", b"Azure Kinect")
"""Texts near the begin of a recording; other Matroska files are films."""

HEAD = 1 << 20
"""Number of bytes in which they are sought."""


class AzureKinect(Source):
    """A file ``.mkv`` that ``k4arecorder`` or Azure Kinect Viewer recorded.

    The depth images are read as the depth camera measures them, with its calibration in the file;
    its distortion is taken out. No library of the camera is needed.
    """

    kind: Literal["azure_kinect"] = "azure_kinect"

    suffixes: ClassVar[tuple[str, ...]] = (".mkv",)

    path: InputPath
    """The file."""

    @classmethod
    def accepts(cls, path: Path) -> bool:
        """Returns whether it is the recording of an Azure Kinect, and no other film."""
        if not super().accepts(path):
            return False
        with path.open("rb") as file:
            head = file.read(HEAD)
        return any(mark in head for mark in MARKS)

    def open(self) -> Stream:
        """Opens the recording at its first depth image.

        Raises:
            DataError: If it is missing, damaged, or without depth images or calibration.
        """
        with reading(self.path, "a recording of Azure Kinect"):
            file = self.path.open("rb")
            try:
                track = DepthTrack.read(file)
                lens = lens_of(track.calibration, track.width, track.height)
                return AzureKinectStream(self.path, file, track, lens)
            except BaseException:
                file.close()
                raise


class AzureKinectStream(Stream):
    """The depth images of a recording."""

    def __init__(self, path: Path, file: BinaryIO, track: DepthTrack, lens: Lens) -> None:
        """Takes over the open file of a track."""
        self.name = path.stem
        self.fps = round(1e9 / track.period, 3)
        self._path, self._file, self._track, self._lens = path, file, track, lens
        self._blocks = track.blocks(file)
        self._count = 0

    def read(self) -> TimedFrame | None:
        """Returns the next image; None at the end.

        Raises:
            DataError: If the image is damaged.
            SourceLostError: If the file is damaged behind the last image.
        """
        if self._file.closed:
            return None
        place = f"{self._path}: image {self._count}"
        try:
            found = next(self._blocks, None)
        except (DataError, OSError) as error:
            self.close()
            reason = error.message if isinstance(error, DataError) else foreign(error)
            raise SourceLostError(reason, place=place) from None
        if found is None:
            return None
        self._count += 1
        time, block = found
        with reading(place, "a depth image"):
            at = checked_time(time, place=place)
            depth = self._track.image(self._file, block) / self.depth_scale
            return TimedFrame(Frame.of_image(depth, self._lens, place=place), at)

    def close(self) -> None:
        """Closes the file."""
        self._file.close()
