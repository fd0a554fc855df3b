"""Overlap of a body with itself: pairs of capsules that must not sink into each other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from regkit.body import Body
from regkit.geometry.capsules import Capsules
from regkit.system.arrays import Array, Indices
from regkit.system.brief import Brief

DEEPEST = 0.15
"""Overlap that is allowed, as a fraction of the sum of the radii: flesh gives way."""


@dataclass(frozen=True)
class SelfOverlap(Brief):
    """Pairs of capsules on segments that no joint connects.

    Attributes:
        capsules: The body's capsules, in the frames of their segments.
        first: Index of the first capsule of each pair, (P,).
        second: Index of the second capsule of each pair, (P,).
        deepest: Allowed overlap of each pair, as a fraction of the sum of the radii, (P,).
    """

    capsules: Capsules
    first: Indices
    second: Indices
    deepest: Array

    @classmethod
    def of(cls, body: Body) -> Self:
        """Returns the pairs of a body; what overlaps at rest or in a stance may do so as deeply."""
        capsules, bones = body.capsules, body.skeleton
        one, two = np.triu_indices(len(capsules), 1)
        apart = ~bones.adjacent[capsules.segments[one], capsules.segments[two]]
        pairs = cls(capsules, one[apart], two[apart], np.full(apart.sum(), DEEPEST))
        poses = [bones.rest(), *(stance.pose for stance in body.stances)]
        known = pairs.depths(np.array([body.place(pose).transforms for pose in poses]))
        # The tolerance keeps rounding from refusing the stance itself.
        return cls(capsules, pairs.first, pairs.second, np.maximum(DEEPEST, known.max(0) + 1e-6))

    def depths(self, transforms: Array) -> Array:
        """Returns the overlap of each pair, as a fraction of the sum of the radii, (N, P).

        It is negative where there is a gap, and measured between the spheres at the nearest points
        of the axes.

        Args:
            transforms: T_world_segment in N poses, (N, S, 4, 4).
        """
        carriers = transforms[:, self.capsules.segments]
        ends = self.capsules.ends @ np.swapaxes(carriers[..., :3, :3], -1, -2)
        ends += carriers[..., None, :3, 3]
        one, two = ends[:, self.first], ends[:, self.second]
        shares = _nearest(one, two)
        nearest = [
            pair[..., 0, :] + share[..., None] * (pair[..., 1, :] - pair[..., 0, :])
            for pair, share in zip((one, two), shares, strict=True)
        ]
        distances = np.linalg.norm(nearest[1] - nearest[0], axis=-1)
        radii = np.zeros(distances.shape)
        for rows, share in zip((self.first, self.second), shares, strict=True):
            start, end = self.capsules.radii[rows].T
            radii += start + share * (end - start)
        return np.asarray(1.0 - distances / radii)

    def allowed(self, transforms: Array) -> NDArray[np.bool_]:
        """Returns whether no pair overlaps too deeply in each of N poses, (N,).

        Args:
            transforms: T_world_segment, (N, S, 4, 4).
        """
        return np.asarray((self.depths(transforms) <= self.deepest).all(axis=1))


def _nearest(one: Array, two: Array) -> tuple[Array, Array]:
    """Returns the places (...) of the nearest points on line segments (..., 2, 3), from 0 to 1.

    Source: Ericson, Real-Time Collision Detection, 2005, section 5.1.9.
    """
    along, across = one[..., 1, :] - one[..., 0, :], two[..., 1, :] - two[..., 0, :]
    gap = one[..., 0, :] - two[..., 0, :]
    a, e = _dot(along, along), _dot(across, across)
    b, c, f = _dot(along, across), _dot(along, gap), _dot(across, gap)
    # A length of zero has all products zero, so any positive divisor yields the place 0.
    long_a, long_e = np.where(a > 0.0, a, 1.0), np.where(e > 0.0, e, 1.0)
    determinant = a * e - b * b
    crossing = determinant > 1e-9 * long_a * long_e
    first = (b * f - c * e) / np.where(crossing, determinant, 1.0)
    first = np.where(crossing, np.clip(first, 0.0, 1.0), 0.0)
    second = np.clip((b * first + f) / long_e, 0.0, 1.0)
    return np.clip((b * second - c) / long_a, 0.0, 1.0), second


def _dot(left: Array, right: Array) -> Array:
    return np.asarray(np.einsum("...i,...i->...", left, right))
