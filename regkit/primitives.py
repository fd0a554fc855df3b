"""Primitives: the pieces of a shape model, fixed in the segments of a skeleton.

Three frames meet here. A primitive's own *axes* are where its scales are given; the *segment*
carries it; the *world* is where a kernel compares it with data.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Generic, Self, TypeVar

import numpy as np

from regkit.arrays import Array, Indices


def _sphere() -> Array:
    """Unit vectors in all directions, (P, 3), along 24 meridians."""
    polar, around = np.mgrid[0 : np.pi : 13j, 0 : 2.0 * np.pi : 25j][:, :, :-1].reshape(2, -1)
    flat = np.sin(polar)
    return np.column_stack([flat * np.cos(around), np.cos(polar), flat * np.sin(around)])


SPHERE = _sphere()
"""Directions in which surfaces are sampled for pictures."""


@dataclass(frozen=True)
class Primitives:
    """K primitives in the frames of their segments; a subclass gives the scales their meaning.

    Attributes:
        segments: The segment that carries each primitive, (K,).
        centres: Positions in the segments' frames, (K, 3) [m].
        axes: R_segment_primitive, (K, 3, 3).
        scales: Sizes along the primitive's own axes, (K, 3) [m].
        weights: (K,).
    """

    segments: Indices
    centres: Array
    axes: Array
    scales: Array
    weights: Array

    def __len__(self) -> int:
        """Number K of primitives."""
        return len(self.segments)

    def place(self, transforms: Array) -> Placed[Self]:
        """The primitives in the world, for T_world_segment (S, 4, 4)."""
        carriers = transforms[self.segments]
        rotations = carriers[:, :3, :3]
        centres = (rotations @ self.centres[:, :, None])[:, :, 0] + carriers[:, :3, 3]
        return Placed(self, carriers[:, :3, 3], centres, rotations @ self.axes)

    def scaled(self, factor: float) -> Self:
        """The same primitives on a skeleton whose lengths are multiplied by ``factor``."""
        return replace(self, centres=factor * self.centres, scales=factor * self.scales)


@dataclass(frozen=True)
class Volumes(Primitives):
    """Primitives that fill a part of space, which terms take as the ellipsoids of two scales."""

    def surface_points(self) -> Array:
        """Points all over the surface of each, in its own axes about its centre, (K, P, 3) [m].

        Pictures show the outline of their hull. Here it is that of the ellipsoid of two scales; a
        subclass whose surface is another one overrides it.
        """
        return np.asarray(2.0 * self.scales[:, None, :] * SPHERE)


@dataclass(frozen=True)
class Gaussians(Volumes):
    """Un-normalised Gaussians, eqs. 1 and 3; the scales are standard deviations.

    ``G(x) = weight * exp(-1/2 (x - m)^T C^-1 (x - m))`` with the covariance C = R diag(scales^2)
    R^T. (The paper writes C for the matrix in the exponent and calls it a covariance; there it is a
    precision.)
    """


@dataclass(frozen=True)
class SurfaceGaussians(Gaussians):
    """Gaussians of which a camera, where there is one, sees only the front."""


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
        """The same capsules on a skeleton whose lengths are multiplied by ``factor``."""
        larger = super().scaled(factor)
        return replace(larger, halves=factor * self.halves, radii=factor * self.radii)


P_co = TypeVar("P_co", bound=Primitives, covariant=True)


@dataclass(frozen=True)
class Placed(Generic[P_co]):
    """Primitives in the world.

    Attributes:
        primitives: What is placed.
        carriers: Origins of the segments that carry the primitives, (K, 3) [m].
        centres: Positions in the world, (K, 3) [m].
        axes: R_world_primitive, (K, 3, 3).
    """

    primitives: P_co
    carriers: Array
    centres: Array
    axes: Array

    def __len__(self) -> int:
        """Number K of primitives."""
        return len(self.centres)

    def covariances(self) -> Array:
        """``R diag(scales^2) R^T`` in the world, (K, 3, 3) [m^2]."""
        return (self.axes * self.primitives.scales[:, None, :] ** 2) @ np.swapaxes(self.axes, 1, 2)

    def gather(self, wrenches: Array, segments: int) -> Array:
        """Wrenches (K, 6) on the primitives as (S, 6), summed about the segments' origins."""
        # Imported when first used, for Numba takes its time to load.
        from regkit.gathering import gathered_wrenches

        arms = self.centres - self.carriers
        return gathered_wrenches(wrenches, arms, self.primitives.segments, segments)

    def gather_stiffness(self, stiffness: Array, segments: int) -> Array:
        """Blocks (K, 6, 6) on the primitives as (S, 6, 6), summed about the segments' origins."""
        from regkit.gathering import gathered_stiffness

        arms = self.centres - self.carriers
        return gathered_stiffness(stiffness, arms, self.primitives.segments, segments)
