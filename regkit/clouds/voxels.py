"""Downsampling clouds: one point for each occupied cube."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array, Indices

FINEST = 1e-6
"""Voxels smaller than this part of a cloud's extent are not tried."""


def voxel_downsampled(points: Array, voxel: float) -> Array:
    """The mean of the points (N, 3) in each occupied cube of side ``voxel`` [m], (M, 3)."""
    _, cell, counts = np.unique(_numbers(points, voxel), return_inverse=True, return_counts=True)
    sums = [np.bincount(cell, weights=column) for column in points.T]
    return np.column_stack(sums) / counts[:, None]


def voxel_for(points: Array, wanted: int) -> float | None:
    """The side [m] of cubes of which about ``wanted`` are occupied.

    None if there are no more points than that.
    """
    if len(points) <= wanted:
        return None
    extent = float(np.ptp(points, axis=0).max())
    lower, upper = FINEST * extent, extent
    # Halving the logarithm a dozen times tells the side within a thousandth of its range.
    for _ in range(12):
        middle = float(np.sqrt(lower * upper))
        if len(np.unique(_numbers(points, middle))) > wanted:
            lower = middle
        else:
            upper = middle
    return upper


def _numbers(points: Array, voxel: float) -> Indices:
    """The number of the cube that each point is in, (N,)."""
    cells = np.floor(points / voxel).astype(np.int64)
    cells -= cells.min(axis=0)
    # One number for each cell sorts much faster than three.
    _, height, depth = cells.max(axis=0) + 1
    return np.asarray((cells[:, 0] * height + cells[:, 1]) * depth + cells[:, 2])
