"""Points sorted into the cells of a grid, in a compiled loop."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled


class Buckets(NamedTuple):
    """Points by the cells of a grid.

    Attributes:
        low: Corner of the grid, (3,) [m].
        size: Side of a cell [m].
        counts: Number of cells along each axis, (3,).
        firsts: Place in ``order`` of the first point of each cell, and of the end, (C + 1,).
        order: Indices of the points, cell by cell, (N,).
    """

    low: Array
    size: float
    counts: Indices
    firsts: Indices
    order: Indices


@compiled
def buckets_of(points: Array, size: float) -> Buckets:
    """Returns points (N, 3) [m] by cells of a size [m]."""
    low, counts = np.empty(3), np.empty(3, np.int64)
    for d in range(3):
        least = most = points[0, d]
        for n in range(len(points)):
            least, most = min(least, points[n, d]), max(most, points[n, d])
        low[d], counts[d] = least, int((most - least) / size) + 1
    cells = np.empty(len(points), np.int64)
    firsts = np.zeros(counts[0] * counts[1] * counts[2] + 1, np.int64)
    for n in range(len(points)):
        cell = 0
        for d in range(3):
            cell = cell * counts[d] + int((points[n, d] - low[d]) / size)
        cells[n] = cell
        firsts[cell + 1] += 1
    for cell in range(len(firsts) - 1):
        firsts[cell + 1] += firsts[cell]
    order, taken = np.empty(len(points), np.int64), np.zeros(len(firsts), np.int64)
    for n in range(len(points)):
        cell = cells[n]
        order[firsts[cell] + taken[cell]] = n
        taken[cell] += 1
    return Buckets(low, size, counts, firsts, order)


@compiled
def pairs_within(points: Array, radius: float) -> Indices:
    """Returns the pairs of points (N, 3) within a radius [m], (P, 2), the smaller index first."""
    buckets = buckets_of(points, radius)
    low, counts = buckets.low, buckets.counts
    pairs, found = np.empty((64 * len(points), 2), np.int64), 0
    for i in range(len(points)):
        a = int((points[i, 0] - low[0]) / radius)
        b = int((points[i, 1] - low[1]) / radius)
        c = int((points[i, 2] - low[2]) / radius)
        for x in range(max(a - 1, 0), min(a + 2, counts[0])):
            for y in range(max(b - 1, 0), min(b + 2, counts[1])):
                # Cells along the last axis follow one another.
                row = (x * counts[1] + y) * counts[2]
                first = buckets.firsts[row + max(c - 1, 0)]
                last = buckets.firsts[row + min(c + 2, counts[2])]
                for place in range(first, last):
                    j = buckets.order[place]
                    u, v = points[j, 0] - points[i, 0], points[j, 1] - points[i, 1]
                    w = points[j, 2] - points[i, 2]
                    if j <= i or u * u + v * v + w * w >= radius * radius:
                        continue
                    if found == len(pairs):
                        more = np.empty((2 * found, 2), np.int64)
                        for n in range(found):
                            more[n, 0], more[n, 1] = pairs[n, 0], pairs[n, 1]
                        pairs = more
                    pairs[found, 0], pairs[found, 1] = i, j
                    found += 1
    return pairs[:found]
