"""Pinhole cameras: x to the right, y down, z forward, in metres and pixels."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from regkit.system.arrays import Array
from regkit.system.errors import DataError


@dataclass(frozen=True)
class Camera:
    """Intrinsics of a pinhole camera without distortion.

    Attributes:
        width: Image width [px].
        height: Image height [px].
        fx: Horizontal focal length [px].
        fy: Vertical focal length [px].
        cx: Column of the principal point [px]; zero is the centre of the first column.
        cy: Row of the principal point [px]; zero is the centre of the first row.
    """

    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float

    def back_projected(self, depth: Array) -> Array:
        """Returns the points (N, 3) [m] of all pixels with depth > 0, in row-major order.

        Args:
            depth: Distance along the optical axis, (H, W) [m]; zero marks an invalid pixel.

        Raises:
            DataError: If the image size differs from the camera's.
        """
        if depth.shape != (self.height, self.width):
            raise DataError(
                f"the depth image has {depth.shape[1]}x{depth.shape[0]} pixels, but the camera has "
                f"{self.width}x{self.height}; use the intrinsics of this image"
            )
        rows, columns = np.nonzero(depth > 0.0)
        z = depth[rows, columns]
        return np.column_stack(
            [(columns - self.cx) * z / self.fx, (rows - self.cy) * z / self.fy, z]
        )

    def projected(self, points: Array) -> Array:
        """Returns pixel coordinates (N, 2), column and row, of points (N, 3) [m] with z > 0."""
        z = points[:, 2]
        return np.column_stack(
            [self.fx * points[:, 0] / z + self.cx, self.fy * points[:, 1] / z + self.cy]
        )

    def rays(self) -> Array:
        """Returns the ray direction of each pixel, (H, W, 3), scaled to z = 1."""
        rows, columns = np.mgrid[: self.height, : self.width]
        return np.stack(
            [(columns - self.cx) / self.fx, (rows - self.cy) / self.fy, np.ones(rows.shape)],
            axis=-1,
        )

    @classmethod
    def read(cls, path: Path) -> Camera:
        """Reads Open3D's ``PinholeCameraIntrinsic`` JSON, whose matrix is column-major.

        Raises:
            DataError: If the file is missing, is not such a JSON file, or has a size or a focal
                length that is not positive.
        """
        try:
            content = json.loads(path.read_text(encoding="utf-8"))
            matrix: NDArray[np.float64] = np.array(content["intrinsic_matrix"], dtype=float)
            matrix = matrix.reshape(3, 3, order="F")
            width, height = int(content["width"]), int(content["height"])
        except FileNotFoundError:
            raise DataError(
                "the file is missing; it should hold the camera's intrinsics", place=str(path)
            ) from None
        except (KeyError, ValueError, TypeError) as error:
            raise DataError(
                f"not a camera file ({type(error).__name__}: {error}); it must have width, height "
                "and intrinsic_matrix (9 numbers, column-major), as Open3D writes them",
                place=str(path),
            ) from None
        if min(width, height, matrix[0, 0], matrix[1, 1]) <= 0:
            raise DataError(
                "width, height and both focal lengths must be positive; they are "
                f"{width}, {height}, {matrix[0, 0]:g} and {matrix[1, 1]:g}",
                place=str(path),
            )
        fx, fy, cx, cy = matrix[[0, 1, 0, 1], [0, 1, 2, 2]].tolist()
        return cls(width, height, fx, fy, cx, cy)

    def to_json(self) -> str:
        """Returns the JSON text that ``read`` accepts."""
        matrix = [self.fx, 0.0, 0.0, 0.0, self.fy, 0.0, self.cx, self.cy, 1.0]
        content = {"width": self.width, "height": self.height, "intrinsic_matrix": matrix}
        return json.dumps(content, indent=2) + "\n"
