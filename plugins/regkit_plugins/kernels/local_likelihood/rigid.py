"""The local-likelihood kernel for a rigid body, whose Gaussians stay where they are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.clouds.tree import Tree
from regkit.interfaces import Response, RigidComparison, RigidSimilarity
from regkit.primitives import Gaussians
from regkit.system.arrays import Array, Indices
from regkit.system.threads import in_chunks
from regkit_plugins.kernels.local_likelihood.compiled_rigid import rigid_mixture, turned

LEAST_SHARE = 1e-6
"""Pairs whose probability is certainly lower are not searched."""

POINTS = 2048
"""Number of data points of a task."""


@dataclass(frozen=True)
class LocalRigidComparison(RigidComparison):
    """The data and the Gaussians of a rigid body.

    Attributes:
        points: Data points, (N, 3) [m].
        directions: Unit normals at the points, (N, 3).
        variances: Variances of the points along their surface, (N,) [m^2].
        weights: Weights of the points, (N,), summing to one.
        flatness: Standard deviation of a data Gaussian along the normal, relative to the surface.
        tree: The tree of the Gaussians' means in the body's frame.
        covariances: Covariances xx, yy, zz, xy, xz, yz of the tree's points, (K, 6) [m^2].
        mixing: Mixture weights of the tree's points divided by (2 pi)^(3/2), (K,).
        background: Density of outliers [1/m^3].
        near: Number of Gaussians that a point is compared with.
        reach: Greatest distance of a pair [m].
    """

    points: Array
    directions: Array
    variances: Array
    weights: Array
    flatness: float
    tree: Tree
    covariances: Array
    mixing: Array
    background: float
    near: int
    reach: float

    @classmethod
    def of(
        cls,
        points: Array,
        directions: Array,
        variances: Array,
        weights: Array,
        flatness: float,
        primitives: Gaussians,
        mixing: Array,
        background: float,
        near: int,
    ) -> LocalRigidComparison:
        """Returns the comparison of data with Gaussians in the body's frame; see the attributes.

        A pair at the distance d has at most the density c |C|^(-1/2) exp(-1/2 d^2 / s^2), where s^2
        is the greatest variance of the body's plus that of the data's Gaussians.
        """
        tree = Tree.of(primitives.centres)
        squares = primitives.scales**2
        peak = float((mixing / np.sqrt(squares.prod(axis=1))).max())
        widest = float(squares.max() + variances.max())
        exponent = np.log(max(peak * near / (LEAST_SHARE * background), 1.0))
        return cls(
            points,
            directions,
            variances,
            weights,
            flatness,
            tree,
            turned(primitives.axes, squares, tree.order),
            mixing[tree.order],
            background,
            near,
            float(np.sqrt(2.0 * exponent * widest)),
        )

    def paired(self, transform: Array) -> LocalRigidSimilarity:
        """Returns the similarity with the nearest Gaussians in the start pose."""
        neighbours = np.empty((len(self.points), self.near), dtype=np.intp)

        def part(begin: int, end: int) -> None:
            # The distances and the moved points of all at once would be the largest arrays.
            moved = (self.points[begin:end] - transform[:3, 3]) @ transform[:3, :3]
            neighbours[begin:end] = self.tree.nearest(moved, self.near, self.reach)[1]

        in_chunks(part, len(self.points), POINTS)
        return LocalRigidSimilarity(self, neighbours)


@dataclass(frozen=True)
class LocalRigidSimilarity(RigidSimilarity):
    """The similarity with fixed pairs.

    Attributes:
        comparison: The data and the Gaussians.
        neighbours: Places in the tree of each point's Gaussians, (N, k); K stands for none.
    """

    comparison: LocalRigidComparison
    neighbours: Indices

    def __call__(self, transform: Array) -> Response:
        """Returns the energy, the wrench (1, 6) and the block (1, 6, 6) of the body."""
        energy, wrench, block, _ = self._mixture(transform)
        return Response(energy, wrench[None], block[None])

    def inlier_probability(self, transform: Array) -> Array:
        """Returns the probability of each point that it is not an outlier, (N,)."""
        return self._mixture(transform)[3]

    def _mixture(self, transform: Array) -> tuple[float, Array, Array, Array]:
        its = self.comparison
        inliers = np.empty(len(its.points))

        data = its.points, its.directions, its.variances, its.weights, self.neighbours
        body = its.flatness, its.tree.points, its.covariances, its.mixing, its.background

        def part(begin: int, end: int) -> tuple[float, Array, Array]:
            return rigid_mixture(*data, *body, transform, inliers, begin, end)

        energy, wrench, block = 0.0, np.zeros(6), np.zeros((6, 6))
        for one, forces, stiffness in in_chunks(part, len(its.points), POINTS):
            energy += one
            wrench += forces
            block += stiffness
        return energy, wrench, block, inliers
