"""Depth images in folders."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from regkit.config.model import InputPath
from regkit.geometry.camera import Camera
from regkit.interfaces import Dataset, Recording
from regkit.observation import Frame, Truth
from regkit.observation.depth_image import read_depth
from regkit_plugins.datasets.formats.recording_folders import (
    RecordingDescription,
    existing,
    numbered_files,
    recordings_in,
)
from regkit_plugins.datasets.formats.truth_file import read_truth


class DepthFolders(Dataset):
    """A folder of 16-bit PNG depth images with its camera, or a folder of such folders."""

    kind: Literal["depth"] = "depth"

    root: InputPath
    """Folder of a recording, or of several recordings."""

    def found(self) -> list[Recording]:
        """Returns a recording for each folder that contains ``depth/``."""
        return recordings_in(self.root, "depth", self._recording, self.wanted)

    def _recording(self, folder: Path) -> DepthRecording:
        description = RecordingDescription.read(folder)
        files = numbered_files(folder / "depth", (".png",))[: self.frames]
        return DepthRecording(
            name=description.name or folder.name,
            fps=description.fps,
            length=len(files),
            folder=folder,
            files=tuple(files),
            depth_scale=description.depth_scale,
        )


@dataclass(frozen=True)
class DepthRecording(Recording):
    """A recording of depth images.

    Attributes:
        folder: Its folder.
        files: The images' files.
        depth_scale: Units per metre.
    """

    folder: Path
    files: tuple[Path, ...]
    depth_scale: float

    def frames(self) -> Iterator[Frame]:
        """Yields the back-projected images."""
        for _, frame in self.some(range(self.length)):
            yield frame

    def some(self, indices: Iterable[int]) -> Iterator[tuple[int, Frame]]:
        """Yields and reads only the images of ``indices``."""
        camera = Camera.read(self.folder / "camera.json")
        for index in sorted(set(indices)):
            path = self.files[index]
            place = str(path)
            depth = read_depth(path) / self.depth_scale
            yield index, Frame(camera.back_projected(depth, place=place), camera, depth, place)

    def input_files(self) -> list[Path]:
        """Returns the frames' files, and those beside them that exist."""
        beside = existing(self.folder, "sequence.yaml", "camera.json", "truth.csv")
        return [*self.files, *beside]

    def truth(self) -> Truth | None:
        """Returns the joints of ``truth.csv``, or None without it."""
        return read_truth(self.folder / "truth.csv", self.length)
