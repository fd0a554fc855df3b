"""Surfels: points of a surface with normals, carried by one or several segments."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self, TypeVar

import numpy as np

from regkit.geometry.surface import SkinnedSurface
from regkit.primitives import Placed, Primitives
from regkit.primitives.skinned_residuals import residuals_on_segments
from regkit.primitives.skinning import accumulated_stiffness, accumulated_wrenches, place_blended
from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class Surfels(Primitives):
    """The vertices of a skinned surface, by linear blend skinning.

    A surfel's segment is its carrier with the largest weight, its third axis is the normal, and
    its scales are half the distance to its neighbours.

    Attributes:
        surface: Positions in the frames of the A carriers, and blend weights.
        normals: Unit outward normals in the carriers' frames, (K, A, 3).
    """

    surface: SkinnedSurface
    normals: Array

    @classmethod
    def of(cls, surface: SkinnedSurface, normals: Array, spacings: Array) -> Self:
        """Returns the vertices of a surface as surfels.

        Args:
            surface: The skinned surface with V vertices.
            normals: Unit normals of the vertices in their carriers' frames, (V, A, 3).
            spacings: Distances between neighbouring vertices, (V,) [m].
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
        """Returns the surfels of a skeleton whose lengths are multiplied by ``factor``."""
        return replace(super().scaled(factor), surface=self.surface.scaled(factor))


S_co = TypeVar("S_co", bound=Surfels, covariant=True)


@dataclass(frozen=True)
class PlacedSurfels(Placed[S_co]):
    """Surfels in the world.

    A force on a surfel is divided among its carriers. Each carrier receives the stiffness that it
    would feel if it moved alone; neglecting the coupling between carriers changes the step but
    never the gradient, and costs no iterations.

    Attributes:
        arms: Vectors from the carriers' origins to the carried positions, (K, A, 3) [m].
        turned: Normals in the world as rotated by each carrier, (K, A, 3).
        lengths: Norms of the blended normals before normalisation, (K,).
    """

    arms: Array
    turned: Array
    lengths: Array

    def accumulate(self, wrenches: Array, segments: int) -> Array:
        """Returns wrenches (K, 6) of the surfels summed about the segments' origins, (S, 6).

        A torque about a surfel's own normal has no effect.
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
        """Returns blocks (K, 6, 6) of the surfels about the segments' origins, (S, 6, 6)."""
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

    def accumulate_residuals(
        self, owners: Indices, values: Array, rows: Array, weights: Array, segments: int
    ) -> tuple[Array, Array]:
        """Returns wrenches (S, 6) and blocks (S, 6, 6) of residuals about the segments' origins."""
        skin = self.primitives.surface
        return residuals_on_segments(
            owners,
            values,
            rows,
            weights,
            skin.segments,
            skin.blend,
            self.arms,
            self.turned,
            self.axes,
            self.lengths,
            segments,
        )


def _axes(normals: Array) -> Array:
    """Returns frames (K, 3, 3) whose third axis is the normal (K, 3)."""
    helpers = np.eye(3)[np.abs(normals).argmin(axis=1)]
    tangents = np.cross(helpers, normals)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    return np.stack([tangents, np.cross(normals, tangents), normals], axis=2)
