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
from regkit.system.errors import DataError
from regkit_plugins.datasets.formats.recording_folders import (
    RecordingDescription,
    numbered_files,
    read_truth,
    recordings_in,
)


class DepthFolders(Dataset):
    """One folder of 16-bit PNG depth images with its camera, or a folder of such folders."""

    kind: Literal["depth"] = "depth"

    root: InputPath
    """The recording's folder, or one that holds several."""

    def found(self) -> list[Recording]:
        """A recording for each folder that has ``depth/``."""
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
    """One folder of depth images.

    Attributes:
        folder: Where it lies.
        files: The images.
        depth_scale: Units per metre.
    """

    folder: Path
    files: tuple[Path, ...]
    depth_scale: float

    def frames(self) -> Iterator[Frame]:
        """The images, back-projected."""
        for _, frame in self.some(range(self.length)):
            yield frame

    def some(self, indices: Iterable[int]) -> Iterator[tuple[int, Frame]]:
        """Only these images are read."""
        camera = Camera.read(self.folder / "camera.json")
        for index in sorted(set(indices)):
            path = self.files[index]
            depth = read_depth(path) / self.depth_scale
            try:
                points = camera.back_projected(depth)
            except DataError as error:
                raise error.at(str(path)) from None
            yield index, Frame(points, camera, depth, place=str(path))

    def truth(self) -> Truth | None:
        """The joints of ``truth.csv``."""
        return read_truth(self.folder / "truth.csv", self.length)
