"""The folder of a recording of point clouds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

from regkit.clouds import read_measured
from regkit.clouds.reading import TEXT
from regkit.geometry.lens import Lens
from regkit.observation import Frame
from regkit.observation.organised import organised_frame
from regkit.recording.folder import RecordingFolder


@dataclass(frozen=True)
class CloudFolder(RecordingFolder):
    """The folder of a recording of point clouds in the camera's frame."""

    content: ClassVar[str] = "clouds"
    suffixes: ClassVar[tuple[str, ...]] = (".npz", ".pcd", ".ply", *TEXT)

    def measured(self, lens: Lens | None = None) -> Callable[[int], Frame]:
        """Returns the function that reads a cloud (x right, y down, z forward)."""

        def read(index: int) -> Frame:
            path = self.files[index]
            found = organised_frame(path, tell=index == 0)
            return found or Frame(read_measured(path), place=str(path))

        return read
