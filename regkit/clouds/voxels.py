"""Voxel downsampling: one point per occupied voxel."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array, Indices

MIN_VOXEL = 1e-6
"""Smallest voxel that is tried, as a fraction of the cloud's extent."""


def voxel_downsampled(points: Array, voxel: float) -> Array:
    """Returns the mean (M, 3) of the points in each occupied voxel.

    Args:
        points: The cloud, (N, 3) [m].
        voxel: Side of a voxel [m].
    """
    _, cell, counts = np.unique(_numbers(points, voxel), return_inverse=True, return_counts=True)
    sums = [np.bincount(cell, weights=column) for column in points.T]
    return np.column_stack(sums) / counts[:, None]


def voxel_for(points: Array, wanted: int) -> float | None:
    """Returns the voxel size [m] for which about ``wanted`` voxels are occupied.

    Returns None if the cloud (N, 3) has at most ``wanted`` points.
    """
    if len(points) <= wanted:
        return None
    extent = float(np.ptp(points, axis=0).max())
    lower, upper = MIN_VOXEL * extent, extent
    # Twelve bisections of the logarithm determine the size to a thousandth of its range.
    for _ in range(12):
        middle = float(np.sqrt(lower * upper))
        if len(np.unique(_numbers(points, middle))) > wanted:
            lower = middle
        else:
            upper = middle
    return upper


def _numbers(points: Array, voxel: float) -> Indices:
    """Returns the voxel number of each point, (N,)."""
    cells = np.floor(points / voxel).astype(np.int64)
    cells -= cells.min(axis=0)
    # A single number per voxel sorts much faster than three.
    _, height, depth = cells.max(axis=0) + 1
    return np.asarray((cells[:, 0] * height + cells[:, 1]) * depth + cells[:, 2])
