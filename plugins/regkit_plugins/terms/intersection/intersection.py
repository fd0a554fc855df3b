"""Intersection: keeps the parts of a body apart."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np

from regkit.body import Body
from regkit.config.quantities import Weight
from regkit.interfaces import CompiledEnergy, Response, Scene, Similarity, Term
from regkit.primitives import Placed, Primitives, Volumes
from regkit.skeleton import Skeleton
from regkit.system.arrays import Array, Indices
from regkit_plugins.terms.intersection.compiled import bind, overlaps, respond

REACH = 3.0
"""Maximum distance of a pair at the start, in units of the sum of their largest scales."""


class Intersection(Term):
    """Penalises the overlap of primitives on non-adjacent segments, as Gaussians of their scales.

    The overlap of each pair is relative to that at coinciding centres, weighted by the smaller
    primitive's fraction of the body.
    """

    kind: Literal["intersection"] = "intersection"
    accepts: ClassVar[type[Primitives]] = Volumes

    weight: Weight = 0.3
    """Weight relative to the kernel's energy."""

    def bind(self, scene: Scene) -> BoundIntersection:
        """Binds the term to the pairs of primitives that may intersect."""
        centres = scene.placed.centres
        first, second, weights, reaches = self._pairs(scene.placed.primitives, scene.body.skeleton)
        near = ((centres[first] - centres[second]) ** 2).sum(axis=1) < reaches**2
        return BoundIntersection(first[near], second[near], weights[near])

    def compiled(self, body: Body, primitives: Primitives) -> CompiledEnergy:
        """Returns the term as compiled functions."""
        table = np.column_stack(self._pairs(primitives, body.skeleton)).astype(np.float64)
        return CompiledEnergy(respond, table=table, bind=bind, state=(len(table) + 1, 3))

    def _pairs(
        self, primitives: Primitives, skeleton: Skeleton
    ) -> tuple[Indices, Indices, Array, Array]:
        """Returns both primitives of each pair that may intersect, its weight and its reach."""
        first, second = _non_adjacent_pairs(primitives.segments, skeleton)
        extents = REACH * primitives.scales.max(axis=1)
        sections = np.sort(primitives.scales, axis=1)[:, 1:].prod(axis=1)
        sizes = sections / sections.sum()
        weights = self.weight * np.minimum(sizes[first], sizes[second])
        return first, second, weights, extents[first] + extents[second]


@dataclass(frozen=True)
class BoundIntersection(Similarity):
    """``sum w exp(-1/2 d^T (C_a + C_b)^-1 d)`` over M pairs, with d = m_a - m_b.

    Attributes:
        first: Index a of each pair, (M,).
        second: Index b of each pair, (M,).
        weights: Weight w of each pair, (M,).
    """

    first: Indices
    second: Indices
    weights: Array

    def __call__(self, placed: Placed[Any], *, curvature: bool = False) -> Response:
        """Returns the energy, exact wrenches, and the semidefinite part of the curvature."""
        # dE/dm_a = -o u and dE/dC_a = o/2 u u^T, with u = S^-1 d; b has the opposite force.
        energy, wrenches, blocks = overlaps(
            placed.centres, placed.covariances(), self.first, self.second, self.weights
        )
        return Response(energy, wrenches, blocks if curvature else None)


def _non_adjacent_pairs(segments: Indices, skeleton: Skeleton) -> tuple[Indices, Indices]:
    """Returns the pairs of primitives on non-adjacent segments, (M,) each."""
    first, second = np.triu_indices(len(segments), k=1)
    apart = ~skeleton.adjacent[segments[first], segments[second]]
    return first[apart], second[apart]
