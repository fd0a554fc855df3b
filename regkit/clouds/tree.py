"""A k-d tree of a cloud, which finds the nearest points on any number of threads."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.clouds.compiled_tree import search, split
from regkit.system.arrays import Array, Indices
from regkit.system.brief import Brief
from regkit.system.threads import each, in_chunks

LEAF = 16
"""Greatest number of points of a leaf."""

ALONE = 3
"""Number of levels of a large tree that are split node by node; the subtrees below are independent
tasks."""

LARGE = 20_000
"""Number of points above which building a tree is divided into tasks."""

QUERIES = 2048
"""Number of queries of a task."""


@dataclass(frozen=True)
class Tree(Brief):
    """A k-d tree.

    SciPy's takes two to three times as long to search, because it is made for any dimension.

    Attributes:
        points: The points in the tree's order, in which neighbours are close, (N, 3) [m].
        order: Index of each point in the cloud, (N,).
        bounds: First point of each node and the one after its last, (2 L, 2).
        axes: Axis across which each inner node is split, (L,).
        cuts: Coordinate at which it is split, (L,) [m].
    """

    points: Array
    order: Indices
    bounds: Indices
    axes: Indices
    cuts: Array

    @classmethod
    def of(cls, cloud: Array) -> Tree:
        """Returns the tree of a cloud (N, 3) [m] of at least one point."""
        points, count = np.array(cloud, dtype=float, order="C"), len(cloud)
        levels = 0
        while count >> levels > LEAF:
            levels += 1
        leaves = 1 << levels
        tree = cls(
            points,
            np.arange(count),
            np.zeros((2 * leaves, 2), dtype=np.intp),
            np.zeros(leaves, dtype=np.intp),
            np.zeros(leaves),
        )
        tree.bounds[1] = 0, count
        alone = ALONE if count > LARGE else 0
        for level in range(alone):
            each(lambda node: tree._split(node, 1), range(1 << level, 2 << level))
        each(lambda node: tree._split(node, levels - alone), range(1 << alone, 2 << alone))
        return tree

    def __len__(self) -> int:
        """Number N of points."""
        return len(self.points)

    def nearest(
        self, queries: Array, count: int, distance: float = np.inf
    ) -> tuple[Array, Indices]:
        """Returns the nearest points of each query, the nearest first.

        Args:
            queries: Where to search, (Q, 3) [m].
            count: Number k of points for each query.
            distance: Distance below which points are found [m].

        Returns:
            Distances (Q, k) [m], infinite for none, and places in ``points`` (Q, k), N for none.
        """
        queries = np.ascontiguousarray(queries, dtype=float)
        found = np.empty((len(queries), count), dtype=np.intp)
        squares = np.empty((len(queries), count))

        tree = self.points, self.bounds, self.axes, self.cuts

        def part(begin: int, end: int) -> None:
            search(*tree, queries, float(distance) ** 2, found, squares, begin, end)

        in_chunks(part, len(queries), QUERIES)
        distances = np.sqrt(squares, out=squares)
        if np.isfinite(distance):
            distances[found == len(self.points)] = np.inf
        return distances, found

    def _split(self, root: int, levels: int) -> None:
        split(self.points, self.order, self.bounds, self.axes, self.cuts, root, levels)
