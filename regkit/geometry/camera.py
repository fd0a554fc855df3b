"""Pinhole cameras: x to the right, y down, z forward, in metres and pixels."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from numbers import Integral
from pathlib import Path
from typing import Any

import numpy as np

from regkit.geometry.compiled_projection import back_project
from regkit.geometry.intrinsics import intrinsics_of
from regkit.system.arrays import Array, loop_input
from regkit.system.errors import DataError
from regkit.system.guard import reading
from regkit.system.json_files import read_json
from regkit.system.notes import note
from regkit.system.printable import shortened

FIELDS = ("width", "height", "intrinsic_matrix")
"""Fields of a camera's file."""

MAX_SIZE = 1 << 15
"""Largest width or height of an image [px]."""

MAX_DISTANCE = 1e4
"""Distance from the camera that no measurement exceeds [m]."""

MIN_FOCAL, MAX_FOCAL = 0.1, 1000.0
"""Range of focal lengths in units of the image's size; the least sees 157 degrees."""


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

    def __post_init__(self) -> None:
        """Raises DataError if no camera can have these intrinsics."""
        for name, size in (("width", self.width), ("height", self.height)):
            if not isinstance(size, Integral) or isinstance(size, bool) or not 0 < size <= MAX_SIZE:
                raise DataError(
                    f"the {name} is {size!r}; it must be a whole number of pixels up to {MAX_SIZE}"
                )
        axes = (("x", self.fx, self.cx, self.width), ("y", self.fy, self.cy, self.height))
        for axis, focal, centre, size in axes:
            if not MIN_FOCAL * size <= focal <= MAX_FOCAL * size:
                raise DataError(
                    f"the focal length f{axis} is {focal:g} px for {size} px; it must be positive, "
                    f"in pixels, and from {MIN_FOCAL:g} to {MAX_FOCAL:g} times the image's size"
                )
            if not -size <= centre <= 2 * size:
                raise DataError(
                    f"the principal point c{axis} is {centre:g} px, far outside the image's "
                    f"{size} px; check the order of the numbers"
                )
        if self.cx == self.cy == 0.0:
            raise DataError(
                "the principal point is the corner of the image, cx = cy = 0; it must be near the "
                "centre: check whether the matrix is by rows or by columns"
            )

    def check_size(self, depth: Array, *, place: str | None = None) -> None:
        """Refuses a depth image (H, W) of another size.

        Raises:
            DataError: If the image size differs from the camera's.
        """
        if depth.shape != (self.height, self.width):
            raise DataError(
                f"the depth image has {depth.shape[1]}x{depth.shape[0]} pixels, but the camera has "
                f"{self.width}x{self.height}; use the intrinsics of this image",
                place=place,
            )

    def back_projected(self, depth: Array, *, place: str | None = None) -> Array:
        """Returns the points (N, 3) [m] of all pixels with depth > 0, in row-major order.

        Args:
            depth: Distance along the optical axis, (H, W) [m]; zero marks an invalid pixel.
            place: Where the image comes from, for messages.

        Raises:
            DataError: If the image size differs from the camera's, or a depth is beyond
                ``MAX_DISTANCE``.
        """
        self.check_size(depth, place=place)
        points, farthest = back_project(
            loop_input(depth), float(self.fx), float(self.fy), float(self.cx), float(self.cy)
        )
        if farthest > MAX_DISTANCE:
            raise DataError(
                f"a depth of {farthest:g} m is farther than any camera measures; check the depth's "
                "unit",
                place=place,
            )
        return points

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
        """Reads Open3D's ``PinholeCameraIntrinsic`` JSON, with its matrix by columns or by rows.

        ``Lens.read`` reads the distortion of the lens too.

        Raises:
            DataError: If the file is missing, or does not describe such a camera.
        """
        content = camera_content(path)
        with reading(path, "a camera file"):
            camera = cls.described_by(content)
        tell_unread(content, path)
        return camera

    @classmethod
    def described_by(cls, content: Mapping[str, Any]) -> Camera:
        """Returns the camera that the content of its file describes.

        Raises:
            DataError: If it does not describe a camera.
        """
        missing = [name for name in FIELDS if name not in content]
        if missing:
            raise DataError(
                f"not a camera file: {', '.join(missing)} missing; it must have width, height "
                "and intrinsic_matrix (9 numbers), as Open3D writes them"
            )
        return cls(content["width"], content["height"], *intrinsics_of(content["intrinsic_matrix"]))

    def to_json(self) -> str:
        """Returns the JSON text that ``read`` accepts."""
        matrix = [self.fx, 0.0, 0.0, 0.0, self.fy, 0.0, self.cx, self.cy, 1.0]
        content = {"width": self.width, "height": self.height, "intrinsic_matrix": matrix}
        return json.dumps(content, indent=2) + "\n"


def camera_content(path: Path) -> dict[str, Any]:
    """Returns the content of a camera's file.

    Raises:
        DataError: If it is missing, or no JSON object.
    """
    if not path.exists():
        raise DataError(
            "the file is missing; it should hold the camera's intrinsics", place=str(path)
        )
    return read_json(path)


def tell_unread(content: Mapping[str, Any], path: Path, besides: tuple[str, ...] = ()) -> None:
    """Tells which fields of a camera's file are not read.

    Args:
        content: The content of the file.
        path: The file.
        besides: Fields that are read besides those of a pinhole camera.
    """
    unread = [name for name in content if name not in (*FIELDS, *besides)]
    if unread:
        note(
            f"passed over: {shortened(', '.join(unread), 200)}; a pinhole camera has no "
            "distortion, and the scale of its images is given elsewhere",
            place=path,
        )
