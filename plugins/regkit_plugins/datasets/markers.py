"""Recordings of a motion-capture system: markers instead of depth."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np

from regkit.config.model import InputPath
from regkit.interfaces import Dataset, Recording
from regkit.observation import Frame, Landmarks
from regkit.recording.markers import Trajectories, read_trajectories
from regkit.system.errors import DataError

AXES = {"y": np.diag([1.0, -1.0, -1.0]), "z": np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])}
"""R_camera_laboratory for each upward axis: x to the right, y down, z forward."""


class MarkerFiles(Dataset):
    """Markers on a body that a motion-capture system measured, in a TRC or C3D file.

    The landmarks of a frame are its markers, and so are its points. The template has a marker of
    the same name for each; ``regkit calibrate --markers`` makes one.
    """

    kind: Literal["markers"] = "markers"

    path: InputPath
    """A ``.trc`` or ``.c3d`` file, or a folder of them."""
    up: Literal["y", "z"] = "y"
    """Axis of the laboratory that points up."""

    def found(self) -> list[Recording]:
        """Returns a recording for each file."""
        files = [self.path]
        if self.path.is_dir():
            suffixes = (".trc", ".c3d")
            files = sorted(one for one in self.path.iterdir() if one.suffix.lower() in suffixes)
        if not files:
            raise DataError("no .trc or .c3d file here", place=str(self.path))
        wanted = [file for file in files if self.wanted(file.stem)]
        return [self._recording(file) for file in wanted or files]

    def _recording(self, file: Path) -> MarkerRecording:
        found = read_trajectories(file)
        length = min(len(found.positions), self.frames or len(found.positions))
        return MarkerRecording(file.stem, found.fps, length, file, found, self.up)


@dataclass(frozen=True)
class MarkerRecording(Recording):
    """The markers of one file.

    Attributes:
        file: The file.
        trajectories: Its markers.
        up: Axis of the laboratory that points up.
    """

    file: Path
    trajectories: Trajectories
    up: Literal["y", "z"]

    def frames(self) -> Iterator[Frame]:
        """Yields the markers of each frame, as points and as landmarks."""
        names = self.trajectories.names
        for number, places in enumerate(self.trajectories.positions[: self.length]):
            turned = places @ AXES[self.up].T
            seen = np.isfinite(turned).all(axis=1)
            place = f"{self.file}: frame {number}"
            landmarks = replace(Landmarks.in_space(names, turned), alone=True)
            yield Frame(turned[seen], place=place, landmarks=landmarks)

    def truth(self) -> None:
        """Returns None: the markers are the data."""

    def input_files(self) -> list[Path]:
        """Returns the file."""
        return [self.file]
