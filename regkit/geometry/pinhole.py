"""The pinhole camera of an organised cloud, fitted to its own rows and columns."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from regkit.geometry.camera import MAX_DISTANCE, Camera
from regkit.system.arrays import Array, Indices
from regkit.system.errors import DataError

FEWEST = 100
"""Fewer measured pixels than this do not determine a camera."""

LINES = 8
"""Fewest rows and columns that must have measurements."""

OWN = 0.5
"""A point is projected into its own pixel if it is within this of the pixel's centre [px]."""

IN_OWN = 0.99
"""Least share of the points that must be projected into their own pixels."""

ROUNDS, DEVIATIONS, EXACT = 4, 3.0, 0.01
"""Number of fits, each without the points that are farther from the last one than this many
standard deviations, or this distance [px]."""


def pinhole_of(points: Array) -> Camera | None:
    """Returns the camera whose image a grid of points is; None if it is no pinhole camera's.

    The column is fx x/z + cx, and the row fy y/z + cy: two lines, fitted by least squares without
    outliers. Nearly all points must be projected into their own pixels.

    Args:
        points: Points in rows and columns, (H, W, 3) [m], in a frame with x to the right, y down
            and z forward; missing measurements are not finite, or zero in all
            three.
    """
    rows, columns = np.nonzero(measured(points))
    x, y, z = points[rows, columns].T
    if len(z) < FEWEST or min(len(np.unique(rows)), len(np.unique(columns))) < LINES:
        return None
    if z.min() <= 0.0 or z.max() > MAX_DISTANCE:
        return None
    # What overflows is no image, which the residuals show.
    with np.errstate(over="ignore", invalid="ignore"):
        across, down = _line(x / z, columns), _line(y / z, rows)
    if across is None or down is None:
        return None
    height, width = points.shape[:2]
    try:
        return Camera(width, height, across[0], down[0], across[1], down[1])
    except DataError:
        # No camera has such numbers.
        return None


def measured(points: Array) -> NDArray[np.bool_]:
    """Returns which points of a grid (H, W, 3) are measurements, (H, W)."""
    return np.asarray(np.isfinite(points).all(axis=2) & points.any(axis=2))


def _line(slopes: Array, pixels: Indices) -> tuple[float, float] | None:
    """Returns focal length and principal point [px]; None if the points do not lie on a line.

    Args:
        slopes: Coordinate of each point, divided by its depth, (N,).
        pixels: Its column or row, (N,).
    """
    kept = np.ones(len(pixels), dtype=bool)
    residuals = np.zeros(len(pixels))
    focal, centre = 0.0, 0.0
    for _ in range(ROUNDS):
        some, targets = slopes[kept], pixels[kept]
        around = some - some.mean()
        spread = float(around @ around)
        if not 0.0 < spread < np.inf:
            return None
        focal = float(around @ targets) / spread
        centre = float(targets.mean() - focal * some.mean())
        residuals = np.abs(focal * slopes + centre - pixels)
        kept = residuals <= max(EXACT, DEVIATIONS * 1.4826 * float(np.median(residuals)))
    return (focal, centre) if (residuals < OWN).mean() >= IN_OWN else None
