"""Depth images stored as a grid of points, one for each pixel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from regkit.geometry.camera import Camera
from regkit.system.arrays import Array
from regkit.system.errors import DataError

MAX_RESIDUAL = 0.5
"""Maximum root mean square error [px] of a pinhole camera fitted to a grid."""


@dataclass(frozen=True)
class Grid:
    """A camera, and the flips of stored rows and columns that make x and y grow along them.

    Attributes:
        camera: Camera fitted to the points.
        turned: Slices that put rows and columns in order.
    """

    camera: Camera
    turned: tuple[slice, slice]

    @classmethod
    def fitted(cls, points: Array, *, place: str) -> Grid:
        """Fits a pinhole camera to the pixels of a frame's points, by least squares.

        Args:
            points: (H, W, 3) in the camera's frame [m]; points that ``measured`` excludes are
                ignored.
            place: Name of the frame, for messages.

        Raises:
            DataError: If there are too few points, or no pinhole camera fits.
        """
        height, width = points.shape[:2]
        rows, columns = np.nonzero(measured(points))
        if len(np.unique(rows)) < 2 or len(np.unique(columns)) < 2:
            raise DataError(
                f"only {len(rows)} points lie in front of the camera, too few to fit it; check the "
                "signs of 'axes'",
                place=place,
            )
        x, y, z = points[rows, columns].T
        fx, cx, miss_x = _line(x / z, columns)
        fy, cy, miss_y = _line(y / z, rows)
        residual = float(np.hypot(miss_x, miss_y))
        if not residual <= MAX_RESIDUAL:
            raise DataError(
                f"no pinhole camera fits the grid of points (error {residual:.1f} pixels); set "
                "camera: false to use the frames as clouds, or correct 'axes'",
                place=place,
            )
        # A negative focal length means that the axis points against the rows or columns.
        across = slice(None, None, 1 if fx > 0.0 else -1)
        down = slice(None, None, 1 if fy > 0.0 else -1)
        cx = cx if fx > 0.0 else width - 1.0 - cx
        cy = cy if fy > 0.0 else height - 1.0 - cy
        return cls(Camera(width, height, abs(fx), abs(fy), cx, cy), (down, across))


def measured(points: Array) -> NDArray[np.bool_]:
    """Returns the mask of measured points (..., 3): finite, and in front of the camera."""
    return np.asarray(np.isfinite(points).all(axis=-1) & (points[..., 2] > 0.0))


def _line(ratios: Array, pixels: NDArray[np.intp]) -> tuple[float, float, float]:
    """Returns slope, offset and root mean square residual of pixels over ratios."""
    matrix = np.column_stack([ratios, np.ones(len(ratios))])
    (slope, offset), *_ = np.linalg.lstsq(matrix, pixels.astype(np.float64), rcond=None)
    miss = matrix @ np.array([slope, offset]) - pixels
    return float(slope), float(offset), float(np.sqrt(np.mean(miss**2)))
