"""Point clouds in folders."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from regkit.clouds import read_cloud
from regkit.config.model import InputPath
from regkit.interfaces import Dataset, Recording
from regkit.observation import Frame, Truth
from regkit_plugins.datasets.formats.recording_folders import (
    RecordingDescription,
    numbered_files,
    read_truth,
    recordings_in,
)

SUFFIXES = (".ply", ".pcd", ".xyz", ".npz")


class CloudFolders(Dataset):
    """One folder of point clouds, or a folder of such folders.

    A ``.npz`` holds the array ``points`` (N, 3) [m]; the other formats are read by Open3D.
    """

    kind: Literal["clouds"] = "clouds"

    root: InputPath
    """The recording's folder, or one that holds several."""

    def found(self) -> list[Recording]:
        """A recording for each folder that has ``clouds/``."""
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
    """One folder of clouds.

    Attributes:
        folder: Where it lies.
        files: The clouds.
    """

    folder: Path
    files: tuple[Path, ...]

    def frames(self) -> Iterator[Frame]:
        """The clouds, in the camera's frame (x right, y down, z forward)."""
        for _, frame in self.some(range(self.length)):
            yield frame

    def some(self, indices: Iterable[int]) -> Iterator[tuple[int, Frame]]:
        """Only these clouds are read."""
        for index in sorted(set(indices)):
            path = self.files[index]
            yield index, Frame(read_cloud(path), place=str(path))

    def truth(self) -> Truth | None:
        """The joints of ``truth.csv``."""
        return read_truth(self.folder / "truth.csv", self.length)
