"""Occupied voxels of a cloud, by a hash table in compiled loops.

The table has open addresses: an entry is the index of a cell, or -1, and a cell whose entry is
taken by another one goes to the next free entry. Cells are stored as whole numbers in floating
point, so that neither tiny voxels nor coordinates far from the origin overflow.
"""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled


@compiled
def scattered(x: int, y: int, z: int) -> int:
    """Returns a number that differs between neighbouring cells in its last bits.

    The primes are those of Teschner et al., Optimized Spatial Hashing for Collision Detection of
    Deformable Objects, 2003, section 4.1.
    """
    number = (x * 73856093) ^ (y * 19349663) ^ (z * 83492791)
    # The last bits of a product depend on the last bits of its factors alone.
    return number ^ (number >> 15)


@compiled
def entry_of(table: Indices, cells: Array, x: float, y: float, z: float) -> int:
    """Returns the entry of a cell in the table, or the free one where it belongs.

    Args:
        table: Indices of cells, (T,), -1 where free; T is a power of two.
        cells: Coordinates of the cells, (C, 3).
        x: First coordinate of the cell.
        y: Second coordinate of the cell.
        z: Third coordinate of the cell.
    """
    mask = len(table) - 1
    entry = scattered(int(x), int(y), int(z)) & mask
    while True:
        index = table[entry]
        if index < 0:
            return entry
        if cells[index, 0] == x and cells[index, 1] == y and cells[index, 2] == z:
            return entry
        entry = (entry + 1) & mask


@compiled
def occupied(points: Array, voxel: float, low: Array, most: int) -> int:
    """Returns the number of occupied voxels, or ``most + 1`` if there are more.

    Args:
        points: The cloud, (N, 3) [m].
        voxel: Side of a voxel [m], at least 2^-20 of the cloud's extent.
        low: Least coordinates of the cloud, (3,) [m].
        most: Number beyond which counting stops.
    """
    size = 8
    while size < 3 * most:
        size *= 2
    mask = size - 1
    taken = np.full(size, -1)
    a, b, c = np.floor(low[0] / voxel), np.floor(low[1] / voxel), np.floor(low[2] / voxel)
    count = 0
    for n in range(len(points)):
        x = int(np.floor(points[n, 0] / voxel) - a)
        y = int(np.floor(points[n, 1] / voxel) - b)
        z = int(np.floor(points[n, 2] / voxel) - c)
        # Each coordinate has 21 bits, so that the number stands for the cell.
        number = (x << 42) | (y << 21) | z
        entry = scattered(x, y, z) & mask
        while taken[entry] != number:
            if taken[entry] < 0:
                taken[entry] = number
                count += 1
                break
            entry = (entry + 1) & mask
        if count > most:
            break
    return count


@compiled
def voxel_sums(points: Array, voxel: float) -> tuple[Array, Array, Indices]:
    """Returns cells (M, 3), sums (M, 3) [m] and numbers of points (M,) of the occupied voxels.

    The voxels have the order of their first points, and a sum is in the order of the points.

    Args:
        points: The cloud, (N, 3) [m].
        voxel: Side of a voxel [m].
    """
    table = np.full(1024, -1)
    room = 512
    cells, sums, counts = np.empty((room, 3)), np.empty((room, 3)), np.empty(room, np.int64)
    count = 0
    for n in range(len(points)):
        x, y, z = points[n, 0] / voxel, points[n, 1] / voxel, points[n, 2] / voxel
        x, y, z = np.floor(x), np.floor(y), np.floor(z)
        entry = entry_of(table, cells, x, y, z)
        index = table[entry]
        if index >= 0:
            for axis in range(3):
                sums[index, axis] += points[n, axis]
            counts[index] += 1
            continue
        if count == room:
            # Half of the entries are taken: all move into tables of twice the size.
            room *= 2
            more = np.empty((room, 3))
            more[:count] = cells
            cells = more
            more = np.empty((room, 3))
            more[:count] = sums
            sums = more
            larger = np.empty(room, np.int64)
            larger[:count] = counts
            counts = larger
            table = np.full(2 * room, -1)
            for c in range(count):
                table[entry_of(table, cells, cells[c, 0], cells[c, 1], cells[c, 2])] = c
            entry = entry_of(table, cells, x, y, z)
        table[entry] = count
        cells[count, 0], cells[count, 1], cells[count, 2] = x, y, z
        for axis in range(3):
            sums[count, axis] = points[n, axis]
        counts[count] = 1
        count += 1
    return cells[:count], sums[:count], counts[:count]


@compiled
def means_in_order(sums: Array, counts: Indices, order: Indices) -> Array:
    """Returns the means (M, 3) of sums (M, 3) of M numbers of points, in an order (M,)."""
    means = np.empty((len(order), 3))
    for m in range(len(order)):
        index = order[m]
        for axis in range(3):
            means[m, axis] = sums[index, axis] / counts[index]
    return means
