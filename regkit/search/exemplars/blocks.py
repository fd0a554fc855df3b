"""The data as a small image about the body: what exemplars are rendered against."""

from __future__ import annotations

import numpy as np
import scipy

from regkit.geometry.camera import Camera
from regkit.search.exemplars.model import Grid
from regkit.system.arrays import Array

ACROSS = 44
"""Number of blocks over the longer side of the data; outlines need no higher resolution."""

MARGIN = 0.35
"""Width of the margin around the data, as a fraction of their longer side."""

FILLED = 0.35
"""Fraction of a block's pixels that must have depth."""

ONE_SURFACE = 0.15
"""Pixels of a block that are farther than this behind its nearest one do not count [m]."""


def grid_around(camera: Camera, depth: Array, points: Array) -> Grid:
    """Returns the blocks of a depth image around points.

    Args:
        camera: The camera.
        depth: Its depth image, (H, W) [m]: zero where nothing is, NaN where it is unknown.
        points: The data, (N, 3) [m].
    """
    pixels = camera.projected(points)
    low, high = pixels.min(axis=0), pixels.max(axis=0)
    extent = float((high - low).max())
    side = max(1, round(extent / ACROSS))
    left, top = np.floor(low - MARGIN * extent).astype(int)
    right, bottom = np.ceil(high + MARGIN * extent).astype(int)
    columns, rows = -(-(right - left) // side), -(-(bottom - top) // side)
    # Beyond the picture the data are unknown.
    whole = np.full((rows * side, columns * side), np.nan)
    r0, r1 = max(top, 0), min(top + rows * side, camera.height)
    c0, c1 = max(left, 0), min(left + columns * side, camera.width)
    whole[r0 - top : r1 - top, c0 - left : c1 - left] = depth[r0:r1, c0:c1]
    cells = whole.reshape(rows, side, columns, side).swapaxes(1, 2).reshape(rows, columns, -1)
    blocks = _reduced(cells)
    middle = 0.5 * (side - 1)
    offsets = [(camera.cx - left - middle) / side, (camera.cy - top - middle) / side]
    intrinsics = np.array([camera.fx / side, camera.fy / side, *offsets])
    return Grid(blocks, nearest_shown(blocks), intrinsics)


def nearest_shown(depth: Array) -> Array:
    """Returns row and column (2, H, W) of the nearest block with depth to each block (H, W)."""
    missing = ~(np.isfinite(depth) & (depth > 0.0))
    indices = scipy.ndimage.distance_transform_edt(
        missing, return_distances=False, return_indices=True
    )
    return np.asarray(indices, dtype=float)


def _reduced(cells: Array) -> Array:
    """Returns the depth (H, W) of blocks of pixels (H, W, n)."""
    measured = cells > 0.0
    nearest = np.where(measured, cells, np.inf).min(axis=2)
    close = measured & (cells < nearest[..., None] + ONE_SURFACE)
    count = close.sum(axis=2)
    mean = np.where(close, cells, 0.0).sum(axis=2) / np.maximum(count, 1)
    filled = measured.sum(axis=2) >= max(1.0, FILLED * cells.shape[2])
    empty = np.where(np.isnan(cells).any(axis=2), -1.0, np.inf)
    return np.where(filled, mean, empty)
