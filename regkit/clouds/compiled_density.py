"""Numbers of points around the occupied voxels of a cloud, in compiled loops."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from regkit.clouds.compiled_voxels import scattered, table_of
from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled


@compiled
def counts_around(cells: Array, counts: Indices, reach: int, which: Indices) -> Indices:
    """Returns the number of points in some voxels and those around them, (W,).

    Args:
        cells: Coordinates of the occupied voxels, (M, 3), whole numbers.
        counts: Numbers of their points, (M,).
        reach: Number of voxels on each side that are counted too.
        which: Indices of the voxels, (W,).
    """
    table = cell_table(cells)
    around = np.empty(len(which), np.int64)
    for w in range(len(which)):
        x, y, z = cells[which[w], 0], cells[which[w], 1], cells[which[w], 2]
        around[w] = _around(table, cells, counts, x, y, z, reach)
    return around


@compiled
def dense_points(
    points: Array, voxel: float, cells: Array, counts: Indices, around: Indices, least: float
) -> NDArray[np.bool_]:
    """Returns for each point (N,) whether at least so many points of a sample are around it.

    Args:
        points: The points, (N, 3) [m].
        voxel: Side of a voxel [m].
        cells: Coordinates of the voxels that the sample occupies, (M, 3), whole numbers.
        counts: Numbers of the sample's points, (M,).
        around: Numbers of the sample's points in each voxel and its neighbours, (M,).
        least: Least number of points in a voxel and its neighbours.
    """
    table = cell_table(cells)
    dense = np.empty(len(points), np.bool_)
    for n in range(len(points)):
        x, y, z = points[n, 0] / voxel, points[n, 1] / voxel, points[n, 2] / voxel
        x, y, z = np.floor(x), np.floor(y), np.floor(z)
        index = _index(table, cells, x, y, z)
        # The sample need not have a point in the voxel.
        count = around[index] if index >= 0 else _around(table, cells, counts, x, y, z, 1)
        dense[n] = count >= least
    return dense


@compiled
def cell_table(cells: Array) -> Indices:
    """Returns a table of occupied voxels (M, 3), as ``compiled_voxels`` describes it."""
    size = 8
    while size < 4 * len(cells):
        size *= 2
    return table_of(cells, len(cells), size)


@compiled
def _index(table: Indices, cells: Array, x: float, y: float, z: float) -> int:
    """Returns the index of a voxel; a negative number if it is not in the table."""
    mask = len(table) - 1
    entry = scattered(int(x), int(y), int(z)) & mask
    index: int = table[entry]
    while index >= 0:
        if cells[index, 0] == x and cells[index, 1] == y and cells[index, 2] == z:
            break
        entry = (entry + 1) & mask
        index = table[entry]
    return index


@compiled
def _around(
    table: Indices, cells: Array, counts: Indices, x: float, y: float, z: float, reach: int
) -> int:
    """Returns the number of points in a voxel and those within a reach on each side."""
    total = 0
    for i in range(-reach, reach + 1):
        for j in range(-reach, reach + 1):
            for k in range(-reach, reach + 1):
                index = _index(table, cells, x + i, y + j, z + k)
                if index >= 0:
                    total += counts[index]
    return total
