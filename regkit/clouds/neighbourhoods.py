"""What the neighbours of a cloud's points tell: their distance, and which way a surface lies."""

from __future__ import annotations

import numpy as np

from regkit.clouds.compiled_normals import least_directions
from regkit.system.arrays import Array

NEIGHBOURS = 10
"""So many points, a point itself among them, tell the plane of its surface."""


def spacing(points: Array) -> float:
    """The typical distance of neighbouring points (N, 3) [m]: the median one of the fourth.

    On a square grid the fourth neighbour is one step away; the first of scattered points, or of
    points along a scanner's lines, is much nearer than the surface is sampled.
    """
    from scipy.spatial import KDTree

    some = points[:: max(1, len(points) // 2000)]
    near = min(5, len(points))
    distances, _ = KDTree(points).query(some, near)
    return float(np.median(np.asarray(distances)[:, -1]))


def normals(points: Array, neighbours: int = NEIGHBOURS) -> Array:
    """Unit normals of a surface at its points (N, 3), (N, 3); their sign is arbitrary.

    The normal is the direction in which the nearest points vary least.
    """
    from scipy.spatial import KDTree

    near = min(neighbours, len(points))
    _, indices = KDTree(points).query(points, near)
    return least_directions(points, np.asarray(indices).reshape(len(points), near))
