"""Point clouds in folders."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from regkit.clouds import read_measured
from regkit.clouds.reading import TEXT
from regkit.config.model import InputPath
from regkit.interfaces import Dataset, Recording
from regkit.observation import Frame, Truth
from regkit.observation.organised import organised_frame
from regkit_plugins.datasets.formats.recording_folders import (
    RecordingDescription,
    existing,
    numbered_files,
    recordings_in,
)
from regkit_plugins.datasets.formats.truth_file import read_truth

SUFFIXES = (".npz", ".pcd", ".ply", *TEXT)


class CloudFolders(Dataset):
    """A folder of point clouds, or a folder of such folders.

    A ``.npz`` file holds the array ``points`` (N, 3) [m]. Points that are NaN or infinite are
    missing measurements; a cloud may consist of them. An organised cloud of a pinhole camera is
    its depth image.
    """

    kind: Literal["clouds"] = "clouds"

    root: InputPath
    """Folder of a recording, or of several recordings."""

    def found(self) -> list[Recording]:
        """Returns a recording for each folder that contains ``clouds/``."""
        return recordings_in(self.root, "clouds", self._recording, self.wanted)

    def _recording(self, folder: Path) -> CloudRecording:
        description = RecordingDescription.read(folder)
        files = numbered_files(folder / "clouds", SUFFIXES)[: self.frames]
        return CloudRecording(
            name=description.name or folder.name,
            fps=description.fps,
            length=len(files),
            folder=folder,
            files=tuple(files),
        )


@dataclass(frozen=True)
class CloudRecording(Recording):
    """A recording of point clouds.

    Attributes:
        folder: Its folder.
        files: The clouds' files.
    """

    folder: Path
    files: tuple[Path, ...]

    def frames(self) -> Iterator[Frame]:
        """Yields the clouds in the camera's frame (x right, y down, z forward)."""
        for _, frame in self.some(range(self.length)):
            yield frame

    def some(self, indices: Iterable[int]) -> Iterator[tuple[int, Frame]]:
        """Yields and reads only the clouds of ``indices``."""
        for index in sorted(set(indices)):
            path = self.files[index]
            found = organised_frame(path, tell=index == 0)
            yield index, found or Frame(read_measured(path), place=str(path))

    def input_files(self) -> list[Path]:
        """Returns the frames' files, and those beside them that exist."""
        beside = existing(self.folder, "sequence.yaml", "truth.csv")
        return [*self.files, *beside]

    def truth(self) -> Truth | None:
        """Returns the joints of ``truth.csv``, or None without it."""
        return read_truth(self.folder / "truth.csv", self.length)
