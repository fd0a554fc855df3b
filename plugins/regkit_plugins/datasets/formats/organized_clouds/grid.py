"""Depth images that are stored as a grid of points, one for each pixel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from regkit.geometry.camera import Camera
from regkit.system.arrays import Array
from regkit.system.errors import DataError

MAX_RESIDUAL = 0.5
"""How far a pinhole camera may miss the pixels of a grid [px], as a root mean square."""


@dataclass(frozen=True)
class Grid:
    """A camera, and how the stored rows and columns are turned so that x and y grow along them.

    Attributes:
        camera: Fitted to the points.
        turned: What selects rows and columns in the right order.
    """

    camera: Camera
    turned: tuple[slice, slice]

    @classmethod
    def fitted(cls, points: Array, *, place: str) -> Grid:
        """The pinhole camera that sees a frame's points at their pixels, by least squares.

        Args:
            points: (H, W, 3) in the camera's frame [m]; what ``measured`` refuses does not count.
            place: Of the frame, for messages.

        Raises:
            DataError: If the points are too few, or no pinhole camera sees them at their pixels.
        """
        height, width = points.shape[:2]
        rows, columns = np.nonzero(measured(points))
        if len(np.unique(rows)) < 2 or len(np.unique(columns)) < 2:
            raise DataError(
                f"{len(rows)} points lie before the camera: too few to tell the camera from; are "
                "the signs of 'axes' right?",
                place=place,
            )
        x, y, z = points[rows, columns].T
        fx, cx, miss_x = _line(x / z, columns)
        fy, cy, miss_y = _line(y / z, rows)
        residual = float(np.hypot(miss_x, miss_y))
        if not residual <= MAX_RESIDUAL:
            raise DataError(
                f"no pinhole camera sees the points at their pixels (it misses by {residual:.1f} "
                "pixels); set camera: false to take the frames as clouds, or mend 'axes'",
                place=place,
            )
        # A focal length below zero says that the axis falls along the rows or columns.
        across = slice(None, None, 1 if fx > 0.0 else -1)
        down = slice(None, None, 1 if fy > 0.0 else -1)
        cx = cx if fx > 0.0 else width - 1.0 - cx
        cy = cy if fy > 0.0 else height - 1.0 - cy
        return cls(Camera(width, height, abs(fx), abs(fy), cx, cy), (down, across))


def measured(points: Array) -> NDArray[np.bool_]:
    """Which points (..., 3) were measured: all numbers finite, and before the camera."""
    return np.asarray(np.isfinite(points).all(axis=-1) & (points[..., 2] > 0.0))


def _line(ratios: Array, pixels: NDArray[np.intp]) -> tuple[float, float, float]:
    """Slope, offset and root mean square residual of pixels over ratios."""
    matrix = np.column_stack([ratios, np.ones(len(ratios))])
    (slope, offset), *_ = np.linalg.lstsq(matrix, pixels.astype(np.float64), rcond=None)
    miss = matrix @ np.array([slope, offset]) - pixels
    return float(slope), float(offset), float(np.sqrt(np.mean(miss**2)))
