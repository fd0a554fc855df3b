"""Surfels: points of a surface with their normals, which one or several segments carry."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self, TypeVar

import numpy as np

from regkit.geometry.surface import SkinnedSurface
from regkit.primitives import Placed, Primitives
from regkit.primitives.skinning import accumulated_stiffness, accumulated_wrenches, place_blended
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Surfels(Primitives):
    """The vertices of a skinned surface, by linear blend skinning.

    Their segment is the one that carries them most, their third axis is the normal, and their
    scales are half the distance to their neighbours.

    Attributes:
        surface: Where the segments carry them, and by how much each of them does.
        normals: Unit outward normals in the frames of these, (K, A, 3).
    """

    surface: SkinnedSurface
    normals: Array

    @classmethod
    def of(cls, surface: SkinnedSurface, normals: Array, spacings: Array) -> Self:
        """Returns the vertices of a surface.

        Args:
            surface: The surface.
            normals: Of the vertices, in the frames of their segments, (V, A, 3).
            spacings: How far they are from one another, (V,) [m].
        """
        count = len(surface)
        main = np.arange(count), surface.blend.argmax(axis=1)
        return cls(
            segments=surface.segments[main],
            centres=surface.points[main],
            axes=_axes(normals[main]),
            scales=np.repeat(0.5 * spacings[:, None], 3, axis=1),
            weights=np.ones(count),
            surface=surface,
            normals=normals,
        )

    def place(self, transforms: Array) -> Placed[Self]:
        """Returns the surfels in the world, for T_world_segment (S, 4, 4)."""
        skin = self.surface
        centres, axes, arms, turned, lengths = place_blended(
            transforms,
            skin.segments,
            skin.blend,
            skin.points,
            self.normals,
            self.segments,
            self.axes[:, :, 0],
        )
        carriers = transforms[self.segments, :3, 3]
        return PlacedSurfels(self, carriers, centres, axes, arms, turned, lengths)

    def scaled(self, factor: float) -> Self:
        """Returns the same surfels on a skeleton whose lengths are multiplied by ``factor``."""
        return replace(super().scaled(factor), surface=self.surface.scaled(factor))


S_co = TypeVar("S_co", bound=Surfels, covariant=True)


@dataclass(frozen=True)
class PlacedSurfels(Placed[S_co]):
    """Surfels in the world.

    A force on one is divided among its carriers. So is its stiffness: each carrier gets what it
    would feel if it moved alone. That the carriers of a point feel one another is left out of the
    curvature, which costs no rounds; it is a matter of the step, never of the gradient.

    Attributes:
        arms: From the origin of each carrier to where it carries the surfel, (K, A, 3) [m].
        turned: The normals as each carrier turns them, (K, A, 3).
        lengths: Of the blended normals before they were made unit vectors, (K,).
    """

    arms: Array
    turned: Array
    lengths: Array

    def accumulate(self, wrenches: Array, segments: int) -> Array:
        """Wrenches (K, 6) on the surfels as (S, 6), summed about the segments' origins.

        What would only turn a surfel about its own normal does nothing.
        """
        skin = self.primitives.surface
        return accumulated_wrenches(
            wrenches,
            skin.segments,
            skin.blend,
            self.arms,
            self.turned,
            self.axes,
            self.lengths,
            segments,
        )

    def accumulate_stiffness(self, stiffness: Array, segments: int) -> Array:
        """Blocks (K, 6, 6) on the surfels as (S, 6, 6), about the segments' origins."""
        skin = self.primitives.surface
        return accumulated_stiffness(
            stiffness,
            skin.segments,
            skin.blend,
            self.arms,
            self.turned,
            self.axes,
            self.lengths,
            segments,
        )


def _axes(normals: Array) -> Array:
    """Frames (K, 3, 3) whose third axis is the normal (K, 3)."""
    helpers = np.eye(3)[np.abs(normals).argmin(axis=1)]
    tangents = np.cross(helpers, normals)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    return np.stack([tangents, np.cross(normals, tangents), normals], axis=2)
