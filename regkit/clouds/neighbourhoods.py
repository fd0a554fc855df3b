"""Local properties of a cloud: point spacing and surface normals."""

from __future__ import annotations

import numpy as np

from regkit.clouds.compiled_normals import least_directions
from regkit.system.arrays import Array

NEIGHBOURS = 10
"""Number of points of a neighbourhood, including the point itself, for normal estimation."""


def spacing(points: Array) -> float:
    """Returns the typical point spacing [m]: the median distance to the fourth neighbour.

    On a square grid the fourth neighbour is one step away. The nearest neighbour of scattered
    points, or of points on scan lines, is much closer than the sampling distance of the surface.

    Args:
        points: The cloud, (N, 3) [m].
    """
    from scipy.spatial import KDTree

    some = points[:: max(1, len(points) // 2000)]
    near = min(5, len(points))
    distances, _ = KDTree(points).query(some, near)
    return float(np.median(np.asarray(distances)[:, -1]))


def normals(points: Array, neighbours: int = NEIGHBOURS) -> Array:
    """Returns unit normals (N, 3) of arbitrary sign.

    The normal is the direction of least variance of the nearest points.

    Args:
        points: The cloud, (N, 3) [m].
        neighbours: Number of points of a neighbourhood, including the point itself.
    """
    from scipy.spatial import KDTree

    near = min(neighbours, len(points))
    _, indices = KDTree(points).query(points, near)
    return least_directions(points, np.asarray(indices).reshape(len(points), near))
