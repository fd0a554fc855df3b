"""Removal of points from a frame, in compiled loops."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from regkit.system.arrays import Array
from regkit.system.compiled import compiled


@compiled
def kept_points(points: Array, kept: NDArray[np.bool_]) -> Array:
    """Returns the points (M, 3) of points (N, 3) where a mask (N,) is true."""
    count = 0
    for n in range(len(kept)):
        if kept[n]:
            count += 1
    left, at = np.empty((count, 3)), 0
    for n in range(len(kept)):
        if kept[n]:
            for i in range(3):
                left[at, i] = points[n, i]
            at += 1
    return left


@compiled
def remaining_depth(
    depth: Array, kept: NDArray[np.bool_], free: NDArray[np.bool_], farthest: float
) -> tuple[Array, bool]:
    """Returns a depth image (H, W) [m] in which removed pixels are free (0) or unknown (NaN).

    It also returns whether the masks have an entry for each pixel with depth.

    Args:
        depth: The image, (H, W) [m].
        kept: Mask of the pixels with depth, in row-major order, that are kept, (N,).
        free: Mask of those that are free space where they are removed, (N,).
        farthest: Removed pixels from this depth on are free space too [m].
    """
    height, width = depth.shape
    left, n = np.empty((height, width)), 0
    for row in range(height):
        for column in range(width):
            value = depth[row, column]
            if value > 0.0:
                if n == len(kept):
                    return left, False
                if not kept[n]:
                    value = np.nan if value < farthest and not free[n] else 0.0
                n += 1
            left[row, column] = value
    return left, n == len(kept)
