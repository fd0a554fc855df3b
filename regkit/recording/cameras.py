"""The cameras of a recording, ``cameras.json``: where they are, and where their frames are."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import Field, field_validator

from regkit.config.document import Document
from regkit.config.model import Model
from regkit.geometry.lens import Lens
from regkit.geometry.rigid import checked_rigid
from regkit.system.arrays import Array
from regkit.system.errors import RegkitError
from regkit.system.files import write_text

FILE = "cameras.json"
"""Name of the file in the recording's folder."""

Name = Annotated[str, Field(pattern=r"^\w[\w. -]*$")]
"""Name of a camera, which is valid as a folder's name."""

Number = Annotated[float, Field(ge=-1e6, le=1e6)]
Row = tuple[Number, Number, Number, Number]


class CameraDescription(Model):
    """One camera of a recording."""

    T_world_camera: tuple[Row, Row, Row, Row] | None = None
    """Pose of the camera in the world, by rows [m]; without it the recording cannot be tracked as a
    whole, but ``regkit calibrate --extrinsics`` finds it."""
    folder: str | None = None
    """Folder of its frames, relative to the recording's; by default its name."""
    intrinsics: str | dict[str, Any] | None = None
    """Its intrinsics: a file, relative to the recording's folder, or the content of such a file; by
    default ``camera.json`` in its folder."""
    time_offset_s: Annotated[float, Field(ge=-1e6, le=1e6)] = 0.0
    """What is added to the times of its frames [s], for a clock that is behind."""

    @field_validator("T_world_camera")
    @classmethod
    def _rigid(cls, value: Any) -> Any:
        if value is not None:
            try:
                checked_rigid(value)
            except RegkitError as error:
                raise ValueError(error.message) from None
        return value

    @property
    def pose(self) -> Array | None:
        """T_world_camera (4, 4) [m] with an exactly orthogonal rotation; None if unknown."""
        return None if self.T_world_camera is None else checked_rigid(self.T_world_camera)

    def lens(self, folder: Path) -> Lens | None:
        """Returns the camera if ``intrinsics`` say where it is.

        Args:
            folder: The recording's folder.

        Raises:
            DataError: If the file is missing or describes no camera.
        """
        if isinstance(self.intrinsics, str):
            return Lens.read(folder / self.intrinsics)
        if self.intrinsics is None:
            return None
        return Lens.described_by(self.intrinsics, folder / FILE)


class Cameras(Model):
    """The content of ``cameras.json``."""

    cameras: Annotated[dict[Name, CameraDescription], Field(min_length=1, max_length=64)]
    """The cameras by their names."""
    tolerance_s: Annotated[float, Field(gt=0.0, le=1e3)] | None = None
    """Largest difference of the times of frames that belong together [s]; by default half a period
    of the fastest camera."""

    @classmethod
    def read(cls, folder: Path) -> Cameras:
        """Returns the description of a recording's cameras.

        Raises:
            RegkitError: If the file is missing or invalid.
        """
        return Document.read(folder / FILE).validated(cls)

    def write(self, folder: Path) -> None:
        """Writes the description into a recording's folder.

        Raises:
            DataError: If it cannot be written.
        """
        content = self.model_dump(mode="json", exclude_defaults=True)
        write_text(folder / FILE, json.dumps(content, indent=2) + "\n")

    def placed(
        self, poses: Mapping[str, Array], offsets: Mapping[str, float] | None = None
    ) -> Cameras:
        """Returns the description with other poses of some cameras.

        Args:
            poses: T_world_camera (4, 4) [m] by the cameras' names.
            offsets: ``time_offset_s`` of some cameras [s].
        """
        cameras = dict(self.cameras)
        for name, pose in poses.items():
            rows = tuple(tuple(row) for row in np.asarray(pose).tolist())
            cameras[name] = cameras[name].model_copy(update={"T_world_camera": rows})
        for name, offset in (offsets or {}).items():
            cameras[name] = cameras[name].model_copy(update={"time_offset_s": offset})
        return self.model_copy(update={"cameras": cameras})
