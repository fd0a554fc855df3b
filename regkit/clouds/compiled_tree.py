"""A k-d tree in compiled loops: splitting a cloud, and searching for the nearest points."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled


@compiled
def split(
    points: Array,
    order: Indices,
    bounds: Indices,
    axes: Indices,
    cuts: Array,
    root: int,
    levels: int,
) -> None:
    """Splits the nodes of a subtree at their medians, level by level, across their longest side.

    The nodes are numbered from 1, and those of node i are 2 i and 2 i + 1.

    Args:
        points: The points, (N, 3) [m]; sorted in place.
        order: The points' indices in the cloud, (N,); sorted with them.
        bounds: First point of each node and the one after its last, (2 L, 2); set for the children.
        axes: Axis across which each inner node is split, (L,); set.
        cuts: Coordinate at which it is split, (L,) [m]; set.
        root: Number of the subtree's root.
        levels: Number of levels to split.
    """
    for level in range(levels):
        for node in range(root << level, (root + 1) << level):
            first, last = bounds[node]
            axis, longest = 0, -1.0
            for d in range(3):
                low = high = points[first, d]
                for i in range(first + 1, last):
                    value = points[i, d]
                    low, high = min(low, value), max(high, value)
                if high - low > longest:
                    axis, longest = d, high - low
            middle = (first + last) // 2
            # Quickselect of Hoare: the middle point ends where it would be if all were sorted.
            left, right = first, last - 1
            while left < right:
                pivot = points[(left + right) // 2, axis]
                i, j = left, right
                while i <= j:
                    while points[i, axis] < pivot:
                        i += 1
                    while points[j, axis] > pivot:
                        j -= 1
                    if i <= j:
                        order[i], order[j] = order[j], order[i]
                        for d in range(3):
                            points[i, d], points[j, d] = points[j, d], points[i, d]
                        i += 1
                        j -= 1
                if middle <= j:
                    right = j
                elif middle >= i:
                    left = i
                else:
                    break
            axes[node], cuts[node] = axis, points[middle, axis]
            bounds[2 * node, 0], bounds[2 * node, 1] = first, middle
            bounds[2 * node + 1, 0], bounds[2 * node + 1, 1] = middle, last


@compiled
def search(
    points: Array,
    bounds: Indices,
    axes: Indices,
    cuts: Array,
    queries: Array,
    limit: float,
    found: Indices,
    squares: Array,
    begin: int,
    end: int,
) -> None:
    """Sets the nearest points of each query, the nearest first.

    A branch is left out if its distance is at least that of the farthest point found so far. The
    distance to a branch is summed over the axes (Arya and Mount, Algorithms for fast vector
    quantization, 1993, section 3).

    Args:
        points: The points in the tree's order, (N, 3) [m].
        bounds: Points of the nodes, (2 L, 2).
        axes: Axes of the inner nodes, (L,).
        cuts: Coordinates of their cuts, (L,) [m].
        queries: Where to search, (Q, 3) [m].
        limit: Squared distance below which points are found [m^2].
        found: Places of the k nearest points in the tree's order, (Q, k), N for none; set.
        squares: Their squared distances, (Q, k) [m^2], ``limit`` for none; set.
        begin: First query to search for.
        end: The one after the last.
    """
    near = found.shape[1]
    leaves = len(axes)
    waiting, offsets = np.empty(64, np.int64), np.empty((64, 4))
    for q in range(begin, end):
        x, y, z = queries[q]
        places, best = found[q], squares[q]
        for a in range(near):
            places[a], best[a] = len(points), limit
        worst = limit
        waiting[0] = 1
        for d in range(4):
            offsets[0, d] = 0.0
        top = 1
        while top > 0:
            top -= 1
            square = offsets[top, 3]
            if square >= worst:
                continue
            node = waiting[top]
            u, v, w = offsets[top, 0], offsets[top, 1], offsets[top, 2]
            while node < leaves:
                axis = axes[node]
                if axis == 0:
                    offset = x - cuts[node]
                    beyond = square - u * u + offset * offset
                elif axis == 1:
                    offset = y - cuts[node]
                    beyond = square - v * v + offset * offset
                else:
                    offset = z - cuts[node]
                    beyond = square - w * w + offset * offset
                node = 2 * node + (1 if offset >= 0.0 else 0)
                if beyond < worst:
                    waiting[top] = node ^ 1
                    offsets[top, 0], offsets[top, 1], offsets[top, 2] = u, v, w
                    offsets[top, axis], offsets[top, 3] = offset, beyond
                    top += 1
            for i in range(bounds[node, 0], bounds[node, 1]):
                r, s, t = points[i, 0] - x, points[i, 1] - y, points[i, 2] - z
                square = r * r + s * s + t * t
                if square < worst:
                    a = near - 1
                    while a > 0 and best[a - 1] > square:
                        best[a], places[a] = best[a - 1], places[a - 1]
                        a -= 1
                    best[a], places[a] = square, i
                    worst = best[near - 1]
