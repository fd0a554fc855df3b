"""Occupied voxels of a cloud, by a hash table in compiled loops.

The table has open addresses: an entry is the index of a cell, or -1, and a cell whose entry is
taken by another one goes to the next free entry; its size is a power of two. Cells are stored as
whole numbers in floating point, so that neither tiny voxels nor coordinates far from the origin
overflow.
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
def occupants(points: Array, voxel: float, low: Array, most: int) -> Array:
    """Returns the first point in each occupied voxel (M, 3), of ``most + 1`` voxels at the most.

    Args:
        points: Points of a cloud, (N, 3) [m].
        voxel: Side of a voxel [m], at least 2^-20 of the cloud's extent.
        low: Least coordinates of the cloud, (3,) [m].
        most: Number beyond which counting stops.
    """
    size = 8
    while size < 3 * most:
        size *= 2
    mask = size - 1
    taken, firsts = np.full(size, -1), np.empty((most + 1, 3))
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
                for axis in range(3):
                    firsts[count, axis] = points[n, axis]
                count += 1
                break
            entry = (entry + 1) & mask
        if count > most:
            break
    return firsts[:count]


@compiled
def voxel_sums(points: Array, voxel: float) -> tuple[Array, Array, Indices]:
    """Returns cells (M, 3), sums (M, 3) [m] and numbers of points (M,) of the occupied voxels.

    The voxels have the order of their first points, and a sum is in the order of the points.

    Args:
        points: The cloud, (N, 3) [m].
        voxel: Side of a voxel [m].
    """
    room, count, done = 2048, 0, 0
    table = np.full(2 * room, -1)
    cells, sums, counts = np.empty((room, 3)), np.empty((room, 3)), np.empty(room, np.int64)
    while True:
        done, count = _summed(points, done, voxel, table, cells, sums, counts, count)
        if done == len(points):
            return cells[:count], sums[:count], counts[:count]
        room *= 2
        cells, sums, counts = _larger(cells, room), _larger(sums, room), _more(counts, room)
        table = table_of(cells, count, 2 * room)


@compiled
def _summed(
    points: Array,
    done: int,
    voxel: float,
    table: Indices,
    cells: Array,
    sums: Array,
    counts: Indices,
    count: int,
) -> tuple[int, int]:
    """Adds points to the sums until all rows are taken; returns how many points and rows are done.

    Args:
        points: The cloud, (N, 3) [m].
        done: Number of points that are added already.
        voxel: Side of a voxel [m].
        table: Indices of cells, (T,), -1 where free.
        cells: Coordinates of the cells, (R, 3).
        sums: Sums of their points, (R, 3) [m].
        counts: Numbers of their points, (R,).
        count: Number of rows that are taken.
    """
    mask = len(table) - 1
    for n in range(done, len(points)):
        x, y, z = points[n, 0] / voxel, points[n, 1] / voxel, points[n, 2] / voxel
        x, y, z = np.floor(x), np.floor(y), np.floor(z)
        # A call for each point would take longer than its search.
        entry = scattered(int(x), int(y), int(z)) & mask
        index = table[entry]
        while index >= 0:
            if cells[index, 0] == x and cells[index, 1] == y and cells[index, 2] == z:
                break
            entry = (entry + 1) & mask
            index = table[entry]
        if index >= 0:
            sums[index, 0] += points[n, 0]
            sums[index, 1] += points[n, 1]
            sums[index, 2] += points[n, 2]
            counts[index] += 1
            continue
        if count == len(cells):
            return n, count
        table[entry] = count
        cells[count, 0], cells[count, 1], cells[count, 2] = x, y, z
        sums[count, 0], sums[count, 1] = points[n, 0], points[n, 1]
        sums[count, 2] = points[n, 2]
        counts[count] = 1
        count += 1
    return len(points), count


@compiled
def _larger(rows: Array, room: int) -> Array:
    """Returns rows (M, 3) with room for more."""
    larger = np.empty((room, 3))
    for m in range(len(rows)):
        for axis in range(3):
            larger[m, axis] = rows[m, axis]
    return larger


@compiled
def _more(numbers: Indices, room: int) -> Indices:
    """Returns numbers (M,) with room for more."""
    larger = np.empty(room, np.int64)
    for m in range(len(numbers)):
        larger[m] = numbers[m]
    return larger


@compiled
def table_of(cells: Array, count: int, size: int) -> Indices:
    """Returns a table of a size, with the first cells (C, 3) entered."""
    table = np.full(size, -1)
    mask = size - 1
    for c in range(count):
        entry = scattered(int(cells[c, 0]), int(cells[c, 1]), int(cells[c, 2])) & mask
        while table[entry] >= 0:
            entry = (entry + 1) & mask
        table[entry] = c
    return table


@compiled
def means_in_order(sums: Array, counts: Indices, order: Indices) -> Array:
    """Returns the means (M, 3) of sums (M, 3) of M numbers of points, in an order (M,)."""
    means = np.empty((len(order), 3))
    for m in range(len(order)):
        index = order[m]
        for axis in range(3):
            means[m, axis] = sums[index, axis] / counts[index]
    return means


@compiled
def cell_numbers(cells: Array) -> Array:
    """Returns a number for each cell (M,) in the order of its coordinates; none if they overflow.

    Args:
        cells: Coordinates of the cells, (M, 3).
    """
    if len(cells) == 0:
        return np.empty(0)
    low, high = np.empty(3), np.empty(3)
    for axis in range(3):
        least = most = cells[0, axis]
        for m in range(len(cells)):
            least, most = min(least, cells[m, axis]), max(most, cells[m, axis])
        low[axis], high[axis] = least, most
    height, depth = high[1] - low[1] + 1.0, high[2] - low[2] + 1.0
    if (high[0] - low[0] + 1.0) * height * depth > 2.0**52:
        return np.empty(0)
    numbers = np.empty(len(cells))
    for m in range(len(cells)):
        row = (cells[m, 0] - low[0]) * height + cells[m, 1] - low[1]
        numbers[m] = row * depth + cells[m, 2] - low[2]
    return numbers
