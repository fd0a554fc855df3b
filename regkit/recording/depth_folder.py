"""The folder of a recording of depth images."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

from regkit.geometry.lens import Lens
from regkit.observation import Frame
from regkit.observation.depth_image import read_depth
from regkit.recording.folder import RecordingFolder


@dataclass(frozen=True)
class DepthFolder(RecordingFolder):
    """The folder of a recording of 16-bit PNG depth images with their camera."""

    content: ClassVar[str] = "depth"
    suffixes: ClassVar[tuple[str, ...]] = (".png",)
    beside: ClassVar[tuple[str, ...]] = (*RecordingFolder.beside, "camera.json")

    def measured(self, lens: Lens | None = None) -> Callable[[int], Frame]:
        """Returns the function that reads, rectifies and back-projects an image."""
        camera = lens or Lens.read(self.folder / "camera.json")

        def read(index: int) -> Frame:
            place = str(self.files[index])
            depth = read_depth(self.files[index]) / self.description.depth_scale
            return Frame.of_image(depth, camera, place=place)

        return read
