"""Local properties of a cloud: point spacing and surface normals."""

from __future__ import annotations

import numpy as np

from regkit.clouds.compiled_normals import least_directions
from regkit.clouds.tree import QUERIES, Tree
from regkit.system.arrays import Array
from regkit.system.threads import in_chunks

NEIGHBOURS = 10
"""Number of points of a neighbourhood, including the point itself, for normal estimation."""


def spacing(points: Array) -> float:
    """Returns the typical point spacing [m]: the median distance to the fourth neighbour.

    On a square grid the fourth neighbour is one step away. The nearest neighbour of scattered
    points, or of points on scan lines, is much closer than the sampling distance of the surface.

    Args:
        points: The cloud, (N, 3) [m].
    """
    some = points[:: max(1, len(points) // 2000)]
    distances, _ = Tree.of(points).nearest(some, min(5, len(points)))
    return float(np.median(distances[:, -1]))


def normals(points: Array, neighbours: int = NEIGHBOURS) -> Array:
    """Returns unit normals (N, 3) of arbitrary sign.

    The normal is the direction of least variance of the nearest points.

    Args:
        points: The cloud, (N, 3) [m].
        neighbours: Number of points of a neighbourhood, including the point itself.
    """
    tree = Tree.of(points)
    found = np.empty((len(tree), 3))
    found[tree.order] = tree_normals(tree, neighbours)
    return found


def tree_normals(tree: Tree, neighbours: int = NEIGHBOURS) -> Array:
    """Returns unit normals (N, 3) like ``normals``, in the tree's order of the points."""
    near = min(neighbours, len(tree))
    found = np.empty((len(tree), 3))

    def part(begin: int, end: int) -> None:
        # Neighbours of all points at once would be the largest arrays of a registration.
        _, places = tree.nearest(tree.points[begin:end], near)
        found[begin:end] = least_directions(tree.points, places)

    in_chunks(part, len(tree), QUERIES)
    return found
