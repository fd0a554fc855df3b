"""Distances to the nearest points of a cloud, in a compiled loop."""

from __future__ import annotations

from math import sqrt

import numpy as np

from regkit.system.arrays import Array
from regkit.system.compiled import compiled


@compiled
def nearest_distances(queries: Array, points: Array, most: float) -> Array:
    """Returns the distances (M,) [m] from places to the nearest of some points.

    For up to a few hundred places this is faster than building a tree of the points.

    Args:
        queries: The places, (M, 3) [m].
        points: The points, (N, 3) [m].
        most: Upper bound of the distances that matter [m]; larger ones may be returned as infinite.
    """
    count = len(queries)
    # In one array for each axis, the inner loop runs on several places at once.
    x, y, z = np.empty(count), np.empty(count), np.empty(count)
    squares, low, high = np.empty(count), np.empty(3), np.empty(3)
    for i in range(3):
        low[i], high[i] = np.inf, -np.inf
    for k in range(count):
        x[k], y[k], z[k] = queries[k, 0], queries[k, 1], queries[k, 2]
        squares[k] = np.inf
        for i in range(3):
            low[i] = min(low[i], queries[k, i] - most)
            high[i] = max(high[i], queries[k, i] + most)
    for n in range(len(points)):
        a, b, c = points[n, 0], points[n, 1], points[n, 2]
        if not (low[0] <= a <= high[0] and low[1] <= b <= high[1] and low[2] <= c <= high[2]):
            continue
        for k in range(count):
            square = (x[k] - a) ** 2 + (y[k] - b) ** 2 + (z[k] - c) ** 2
            squares[k] = square if square < squares[k] else squares[k]
    for k in range(count):
        squares[k] = sqrt(squares[k])
    return squares
