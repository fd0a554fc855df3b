"""Intersection: no two parts of a body are in the same place."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from regkit.arrays import Array, Indices
from regkit.interfaces import Response, Scene, Similarity, Term
from regkit.primitives import Placed
from regkit.rotation import axial
from regkit.skeleton import Skeleton

REACH = 3.0
"""Pairs farther apart than so many of their scales together at the start are not looked at."""


class Intersection(Term):
    """Correlation of primitives on segments that are not neighbours, as Gaussians of their scales.

    Each pair's overlap is taken as a part of what it is where both centres fall together, and
    counts by the smaller one's share of the body.
    """

    kind: Literal["intersection"] = "intersection"

    weight: Annotated[float, Field(gt=0.0)] = 0.3
    """Weight against the kernel's energy."""

    def against(self, scene: Scene) -> Overlaps:
        """Bind the term to the pairs of primitives that must not meet."""
        primitives = scene.placed.primitives
        first, second = _strangers(primitives.segments, scene.body.skeleton)
        apart = scene.placed.centres[first] - scene.placed.centres[second]
        reaches = REACH * primitives.scales.max(axis=1)
        near = (apart**2).sum(axis=1) < (reaches[first] + reaches[second]) ** 2
        first, second = first[near], second[near]
        sections = np.sort(primitives.scales, axis=1)[:, 1:].prod(axis=1)
        sizes = sections / sections.sum()
        weights = self.weight * np.minimum(sizes[first], sizes[second])
        carried = np.zeros((len(primitives), 2 * len(first)))
        carried[np.concatenate([first, second]), np.arange(2 * len(first))] = 1.0
        return Overlaps(first, second, weights, carried)


@dataclass(frozen=True)
class Overlaps(Similarity):
    """``sum w exp(-1/2 d^T (C_a + C_b)^-1 d)`` over M pairs, with d = m_a - m_b.

    Attributes:
        first: Index a of the pairs, (M,).
        second: Index b, (M,).
        weights: w, (M,).
        carried: Which primitive each pair's first, then each pair's second is, (K, 2 M).
    """

    first: Indices
    second: Indices
    weights: Array
    carried: Array

    def __call__(self, placed: Placed[Any], *, curvature: bool = False) -> Response:
        """The energy, exact wrenches, and the part of the curvature that is never negative."""
        a, b = self.first, self.second
        whole = placed.covariances()
        apart = placed.centres[a] - placed.centres[b]
        pulled = (np.linalg.inv(whole[a] + whole[b]) @ apart[:, :, None])[:, :, 0]
        overlaps = self.weights * np.exp(-0.5 * (apart * pulled).sum(axis=1))
        # dE/dm_a = -o u and dE/dC_a = o/2 u u^T, with u = S^-1 d; for b the force is opposite.
        turning = pulled[:, :, None] * pulled[:, None, :]
        ways = np.empty((2, len(a), 6))
        ways[0, :, :3], ways[1, :, :3] = -pulled, pulled
        ways[0, :, 3:] = axial(whole[a] @ turning)
        ways[1, :, 3:] = axial(whole[b] @ turning)
        slopes = (overlaps[:, None] * ways).reshape(-1, 6)
        stiffness = None
        if curvature:
            blocks = slopes[:, :, None] * ways.reshape(-1, 1, 6)
            stiffness = (self.carried @ blocks.reshape(-1, 36)).reshape(-1, 6, 6)
        return Response(float(overlaps.sum()), self.carried @ slopes, stiffness)


def _strangers(segments: Indices, skeleton: Skeleton) -> tuple[Indices, Indices]:
    """The pairs of primitives on different segments that no joint ties directly, (M,) each.

    Segments that are fixed to one another count as one.
    """
    first, second = np.triu_indices(len(segments), k=1)
    bodies = skeleton.rigid_groups()
    own = bodies[segments]
    parents = np.array([bodies[p] if p >= 0 else -1 for p in skeleton.parents])
    neighbours = {(int(bodies[s]), int(p)) for s, p in enumerate(parents) if p >= 0}
    apart = [
        x != y and (x, y) not in neighbours and (y, x) not in neighbours
        for x, y in zip(own[first].tolist(), own[second].tolist(), strict=True)
    ]
    return first[apart], second[apart]
