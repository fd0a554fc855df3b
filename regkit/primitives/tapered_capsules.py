"""Tapered capsules as primitives of a shape model."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np

from regkit.primitives.volumes import SPHERE, Volumes
from regkit.system.arrays import Array


@dataclass(frozen=True)
class TaperedCapsules(Volumes):
    """Convex hulls of two spheres on the primitive's second axis; one sphere is a capsule too.

    Terms take a primitive as the ellipsoid of two scales, here that which reaches as far as the
    capsule along its axis and, in the middle, across it.

    Attributes:
        halves: Half the distance of the spheres' centres, which are at the primitive's centre plus
            and minus so much of its second axis, (K,) [m].
        radii: The radius of the sphere at minus and of that at plus, (K, 2) [m]; they differ by
            less than the distance, so that neither sphere holds the other.
    """

    halves: Array
    radii: Array

    @cached_property
    def sines(self) -> Array:
        """How steeply the radius falls along the axis, (K,): sines of the cones' half angles."""
        lengths = np.where(self.halves > 0.0, 2.0 * self.halves, 1.0)
        return np.asarray((self.radii[:, 0] - self.radii[:, 1]) / lengths)

    def surface_points(self) -> Array:
        """Points of the two spheres."""
        ways = self.halves[:, None] * np.array([-1.0, 1.0])
        points = self.radii[:, :, None, None] * SPHERE
        points[..., 1] += ways[:, :, None]
        return points.reshape(len(self), -1, 3)

    def scaled(self, factor: float) -> Self:
        """Returns the same capsules on a skeleton whose lengths are multiplied by ``factor``."""
        larger = super().scaled(factor)
        return replace(larger, halves=factor * self.halves, radii=factor * self.radii)
