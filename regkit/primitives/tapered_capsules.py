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
    """Convex hulls of two spheres on the primitive's second axis; a single sphere is one too.

    Terms approximate a primitive by the ellipsoid of two scales. For a capsule it has the capsule's
    extent along the axis and, in the middle, across it.

    Attributes:
        halves: Half distances of the spheres' centres, (K,) [m]; the centres lie at these distances
            from the primitive's centre along its second axis.
        radii: Radii of the spheres in the negative and the positive direction, (K, 2) [m]. They
            differ by less than the distance of the centres, so that no sphere contains the other.
    """

    halves: Array
    radii: Array

    @cached_property
    def sines(self) -> Array:
        """Sines of the cones' half angles, (K,); positive where the radius falls along the axis."""
        lengths = np.where(self.halves > 0.0, 2.0 * self.halves, 1.0)
        return np.asarray((self.radii[:, 0] - self.radii[:, 1]) / lengths)

    def surface_points(self) -> Array:
        """Returns points of the two spheres, (K, P, 3) [m]."""
        offsets = self.halves[:, None] * np.array([-1.0, 1.0])
        points = self.radii[:, :, None, None] * SPHERE
        points[..., 1] += offsets[:, :, None]
        return points.reshape(len(self), -1, 3)

    def scaled(self, factor: float) -> Self:
        """Returns the capsules of a skeleton whose lengths are multiplied by ``factor``."""
        larger = super().scaled(factor)
        return replace(larger, halves=factor * self.halves, radii=factor * self.radii)
