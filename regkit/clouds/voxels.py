"""Voxel downsampling: one point per occupied voxel."""

from __future__ import annotations

import numpy as np

from regkit.clouds.bounds import POINTS, bounds
from regkit.clouds.compiled_voxels import cell_numbers, means_in_order, occupants, voxel_sums
from regkit.system.arrays import Array, Indices
from regkit.system.threads import in_chunks

MIN_VOXEL = 1e-6
"""Smallest voxel that is tried, as a fraction of the cloud's extent."""


def voxel_downsampled(points: Array, voxel: float) -> Array:
    """Returns the mean (M, 3) of the points in each occupied voxel.

    The voxels are sorted by their first coordinate, then by the second and the third, whatever the
    order of the points.

    Args:
        points: The cloud, (N, 3) [m].
        voxel: Side of a voxel [m].
    """
    cells, sums, counts = voxel_sums(np.ascontiguousarray(points, dtype=float), voxel)
    return means_in_order(sums, counts, sorted_cells(cells))


def voxel_for(points: Array, wanted: int) -> float | None:
    """Returns the voxel size [m] for which about ``wanted`` voxels are occupied.

    Returns None if the cloud (N, 3) has at most ``wanted`` points, or if all of them are equal.
    """
    if len(points) <= wanted:
        return None
    points = np.ascontiguousarray(points, dtype=float)
    low, high = bounds(points)
    extent = float((high - low).max())
    if extent == 0.0:
        return None
    lower, upper = MIN_VOXEL * extent, extent
    # Twelve bisections of the logarithm determine the size to a thousandth of its range.
    for _ in range(12):
        middle = float(np.sqrt(lower * upper))
        if _fills(points, middle, low, wanted):
            lower = middle
        else:
            upper = middle
    return upper


def _fills(points: Array, voxel: float, low: Array, most: int) -> bool:
    """Returns whether points (N, 3) occupy more than ``most`` voxels; see ``occupants``."""
    firsts, done = np.empty((0, 3)), 0
    # A few points are often enough to tell that a voxel is too small, so more and more are counted.
    while done < len(points) and len(firsts) <= most:
        rest = points[done : max(4 * done, 16 * most)]

        def part(begin: int, end: int, rest: Array = rest) -> Array:
            return occupants(rest[begin:end], voxel, low, most)

        firsts = np.concatenate([firsts, *in_chunks(part, len(rest), POINTS)])
        firsts = occupants(firsts, voxel, low, most)
        done += len(rest)
    return len(firsts) > most


def sorted_cells(cells: Array) -> Indices:
    """Returns the order (M,) of cells (M, 3) by their coordinates."""
    numbers = cell_numbers(cells)
    # A single number per voxel sorts much faster than three.
    return np.argsort(numbers) if len(numbers) == len(cells) else np.lexsort(cells.T[::-1])
