"""Tapered capsules: the convex hulls of pairs of spheres, a body's surface in closed form."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class Capsules:
    """C tapered capsules in the frames of their segments, or in the world once placed.

    Attributes:
        segments: The segment that carries each capsule, (C,).
        ends: The centres of the two end spheres, (C, 2, 3) [m].
        radii: Their radii, (C, 2) [m].
    """

    segments: Indices
    ends: Array
    radii: Array

    def __len__(self) -> int:
        """Number C of capsules."""
        return len(self.segments)

    def place(self, transforms: Array) -> Capsules:
        """The capsules in the world, for T_world_segment (S, 4, 4)."""
        carriers = transforms[self.segments]
        ends = self.ends @ np.swapaxes(carriers[:, :3, :3], 1, 2) + carriers[:, None, :3, 3]
        return Capsules(self.segments, ends, self.radii)

    def some(self, chosen: NDArray[np.bool_]) -> Capsules:
        """The capsules where ``chosen`` (C,) is true."""
        return Capsules(self.segments[chosen], self.ends[chosen], self.radii[chosen])

    def scaled(self, factor: float) -> Capsules:
        """The capsules of a body whose lengths are multiplied by ``factor``."""
        return Capsules(self.segments, factor * self.ends, factor * self.radii)

    def nearest(self, points: Array) -> tuple[Indices, Array, Array]:
        """The nearest capsule (N,), the signed distance of its surface (N,) [m], and its gradient.

        The distance is negative inside; the gradient (N, 3) is the unit vector away from the
        surface.
        """
        distances, heights = self._distances(points)
        nearest = distances.argmin(axis=1)
        each = np.arange(len(points))
        start, axis = self.ends[nearest, 0], self.ends[nearest, 1] - self.ends[nearest, 0]
        length = np.linalg.norm(axis, axis=1)
        along = heights[each, nearest] / np.where(length > 0.0, length, 1.0)
        away = points - start - along[:, None] * axis
        norm = np.linalg.norm(away, axis=1, keepdims=True)
        return nearest, distances[each, nearest], away / np.where(norm > 0.0, norm, 1.0)

    def surface_distance(self, points: Array) -> Array:
        """Signed distance of points (N, 3) to the surface of all capsules together, (N,) [m].

        Exact outside; inside it is a bound, for a capsule's surface may lie within its neighbour.
        """
        return np.asarray(self._distances(points)[0].min(axis=1))

    def axis_points(self, spacing: float) -> AxisPoints:
        """Points on the axes, at most ``spacing`` [m] apart."""
        lengths = np.linalg.norm(self.ends[:, 1] - self.ends[:, 0], axis=1)
        # Less a little, so that their number is the same wherever the capsules are placed.
        return self._on_axes(np.ceil(lengths / spacing - 1e-6).astype(np.intp) + 1)

    def axis_samples(self, count: int) -> AxisPoints:
        """``count`` evenly spaced points on each axis."""
        return self._on_axes(np.full(len(self), count, dtype=np.intp))

    def _on_axes(self, counts: Indices) -> AxisPoints:
        """Evenly spaced points on the axes, ``counts`` (C,) on each."""
        capsules = np.repeat(np.arange(len(self)), counts)
        along = np.concatenate([np.linspace(0.0, 1.0, count) for count in counts])
        ends, radii = self.ends[capsules], self.radii[capsules]
        return AxisPoints(
            segments=self.segments[capsules],
            points=ends[:, 0] + along[:, None] * (ends[:, 1] - ends[:, 0]),
            radii=radii[:, 0] + along * (radii[:, 1] - radii[:, 0]),
            capsules=capsules,
            along=along,
        )

    def _distances(self, points: Array) -> tuple[Array, Array]:
        """Signed distance to each capsule, (N, C) [m], and where on its axis the nearest sphere is.

        The surface is the envelope of spheres whose radius falls along the axis with the sine s of
        the cone's half angle. The sphere nearest to a point at the height y along the axis and at
        the distance x from it has its centre at y - s x / sqrt(1 - s^2), kept between the ends.
        """
        start, axis = self.ends[:, 0], self.ends[:, 1] - self.ends[:, 0]
        length = np.linalg.norm(axis, axis=1)
        safe = np.where(length > 0.0, length, 1.0)
        unit = axis / safe[:, None]
        # At |s| = 1 one sphere holds the other: the nearest centre then runs to the larger sphere.
        sine = np.clip((self.radii[:, 0] - self.radii[:, 1]) / safe, -1.0 + 1e-12, 1.0 - 1e-12)
        # With the products on the axes, no (N, C, 3) array is needed.
        height = points @ unit.T - (start * unit).sum(axis=1)
        square = (points**2).sum(axis=1)[:, None] - 2.0 * points @ start.T + (start**2).sum(axis=1)
        side = np.sqrt(np.maximum(square - height**2, 0.0))
        nearest = np.clip(height - side * (sine / np.sqrt(1.0 - sine**2)), 0.0, length)
        radius = self.radii[:, 0] + (self.radii[:, 1] - self.radii[:, 0]) / safe * nearest
        return np.hypot(side, height - nearest) - radius, nearest


@dataclass(frozen=True)
class AxisPoints:
    """Points on the axes of capsules, in the capsules' frames.

    Attributes:
        segments: The segment that carries each, (M,).
        points: (M, 3) [m].
        radii: Radius of the capsule there, (M,) [m].
        capsules: The capsule of each, (M,).
        along: Position on the capsule's axis, from 0 to 1, (M,).
    """

    segments: Indices
    points: Array
    radii: Array
    capsules: Indices
    along: Array

    def place(self, transforms: Array) -> Array:
        """Positions in the world, (..., M, 3) [m], for T_world_segment (..., S, 4, 4)."""
        carriers = transforms[..., self.segments, :, :]
        turned = (carriers[..., :3, :3] @ self.points[:, :, None])[..., 0]
        return np.asarray(turned + carriers[..., :3, 3])
