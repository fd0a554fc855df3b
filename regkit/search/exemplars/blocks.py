"""The data as a small image about the body: what exemplars are rendered against."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import distance_transform_edt

from regkit.geometry.camera import Camera
from regkit.system.arrays import Array

ACROSS = 44
"""Number of blocks over the longer side of the data; outlines need no higher resolution."""

MARGIN = 0.35
"""Width of the margin around the data, as a fraction of their longer side."""

FILLED = 0.35
"""Fraction of a block's pixels that must have depth."""

ONE_SURFACE = 0.15
"""Pixels of a block that are farther than this behind its nearest one do not count [m]."""


@dataclass(frozen=True)
class Blocks:
    """A depth image in blocks.

    Attributes:
        depth: Depth of each block, (H, W) [m]; inf where nothing is, -1 where it is unknown.
        intrinsics: fx, fy, cx, cy in blocks, (4,).
        nearest: Row and column of the nearest block with depth, (2, H, W).
    """

    depth: Array
    intrinsics: Array
    nearest: Array

    @classmethod
    def of(cls, camera: Camera, depth: Array, points: Array) -> Blocks:
        """Returns the blocks around points.

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
        missing = ~(np.isfinite(blocks) & (blocks > 0.0))
        nearest = distance_transform_edt(missing, return_distances=False, return_indices=True)
        middle = 0.5 * (side - 1)
        offsets = [(camera.cx - left - middle) / side, (camera.cy - top - middle) / side]
        intrinsics = np.array([camera.fx / side, camera.fy / side, *offsets])
        return cls(blocks, intrinsics, np.asarray(nearest, dtype=float))


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
