"""Writing of depth recordings in regkit's folder format."""

from __future__ import annotations

import json
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from regkit.geometry.camera import Camera
from regkit.system.arrays import Array
from regkit.system.errors import DataError

_HEADER = "sequence.yaml"

_RUN_LENGTHS = 3
"""zlib's Z_RLE: nearly as compact for noise, and identical for all implementations of zlib."""


@dataclass(frozen=True)
class DepthRecording:
    """Depth images with ground-truth joints.

    Attributes:
        name: Name of the recording.
        fps: Frames per second.
        depth_scale: Units of ``depth`` per metre.
        source: Source of the data.
        licence: Licence of the data.
        camera: Intrinsics.
        depth: Depth images, (T, H, W); 0 for invalid pixels.
        joints: Names of the J joints.
        truth: Joint positions in the camera frame (x right, y down, z forward), (T, J, 3) [m].
    """

    name: str
    fps: float
    depth_scale: float
    source: str
    licence: str
    camera: Camera
    depth: NDArray[np.uint16]
    joints: tuple[str, ...]
    truth: Array

    def write(self, folder: Path) -> None:
        """Writes the folder atomically, and replaces an existing recording.

        Raises:
            DataError: If the folder exists and is not a recording, or cannot be written.
        """
        if folder.exists() and not (folder / _HEADER).is_file():
            raise DataError(
                f"it exists and is not a depth recording (it has no {_HEADER}); name another "
                "folder or remove it",
                place=str(folder),
            )
        try:
            folder.parent.mkdir(parents=True, exist_ok=True)
            self._replace(folder)
        except OSError as error:
            raise DataError(
                f"cannot be written: {error.strerror or error}", place=str(folder)
            ) from None

    def _replace(self, folder: Path) -> None:
        """Writes the files to a temporary folder, and renames it when complete."""
        with tempfile.TemporaryDirectory(dir=folder.parent, prefix=f".{folder.name}-") as scratch:
            new, old = Path(scratch) / "new", Path(scratch) / "old"
            self.write_into(new)
            if folder.exists():
                folder.rename(old)
            new.rename(folder)

    def write_into(self, folder: Path) -> None:
        """Writes the files to a new folder.

        Raises:
            OSError: If they cannot be written.
        """
        images = folder / "depth"
        images.mkdir(parents=True)
        (folder / _HEADER).write_text(self._header(), encoding="utf-8", newline="\n")
        (folder / "camera.json").write_text(self.camera.to_json(), encoding="utf-8", newline="\n")
        if self.joints:
            (folder / "truth.csv").write_text(self._table(), encoding="utf-8", newline="\n")
        for frame, image in enumerate(self.depth):
            Image.fromarray(image).save(
                images / f"{frame:06d}.png", compress_level=9, compress_type=_RUN_LENGTHS
            )

    def _header(self) -> str:
        """Returns the text of ``sequence.yaml``; JSON strings are valid YAML strings."""
        return (
            f"name: {json.dumps(self.name)}\n"
            f"fps: {self.fps:g}\n"
            f"depth_scale: {self.depth_scale:g}\n"
            f"source: {json.dumps(self.source)}\n"
            f"licence: {json.dumps(self.licence)}\n"
        )

    def _table(self) -> str:
        """Returns the text of ``truth.csv``."""
        rows = [
            f"{frame},{joint},{x:.6f},{y:.6f},{z:.6f}\n"
            for frame, positions in enumerate(self.truth)
            for joint, (x, y, z) in zip(self.joints, positions, strict=True)
        ]
        return "frame,joint,x,y,z\n" + "".join(rows)
