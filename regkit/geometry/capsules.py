"""Tapered capsules, the convex hulls of two spheres: a body surface with a closed-form distance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from regkit.geometry.compiled_capsules import nearest_capsules
from regkit.system.arrays import Array, Indices, loop_input
from regkit.system.brief import Brief


@dataclass(frozen=True)
class Capsules(Brief):
    """C tapered capsules, in segment frames or, after ``place``, in the world frame.

    Attributes:
        segments: Index of the segment of each capsule, (C,).
        ends: Centres of the two end spheres, (C, 2, 3) [m].
        radii: Radii of the two end spheres, (C, 2) [m].
    """

    segments: Indices
    ends: Array
    radii: Array

    def __len__(self) -> int:
        """Number C of capsules."""
        return len(self.segments)

    def place(self, transforms: Array) -> Capsules:
        """Returns the capsules in the world frame for T_world_segment (S, 4, 4)."""
        carriers = transforms[self.segments]
        ends = self.ends @ np.swapaxes(carriers[:, :3, :3], 1, 2) + carriers[:, None, :3, 3]
        return Capsules(self.segments, ends, self.radii)

    def selected(self, chosen: NDArray[np.bool_]) -> Capsules:
        """Returns the capsules where the mask ``chosen`` (C,) is true."""
        return Capsules(self.segments[chosen], self.ends[chosen], self.radii[chosen])

    def scaled(self, factor: float) -> Capsules:
        """Returns the capsules with all lengths multiplied by ``factor``."""
        return Capsules(self.segments, factor * self.ends, factor * self.radii)

    def nearest(self, points: Array) -> tuple[Indices, Array, Array]:
        """Returns the nearest capsule of each point and the signed distance to its surface.

        Args:
            points: Query points in the frame of the capsules, (N, 3) [m].

        Returns:
            The index of the nearest capsule (N,), the signed distance (N,) [m], negative inside,
            and its gradient (N, 3), a unit vector that points away from the surface.
        """
        nearest, distances, heights = self._nearest(points)
        start, axis = self.ends[nearest, 0], self.ends[nearest, 1] - self.ends[nearest, 0]
        length = np.linalg.norm(axis, axis=1)
        along = heights / np.where(length > 0.0, length, 1.0)
        away = points - start - along[:, None] * axis
        norm = np.linalg.norm(away, axis=1, keepdims=True)
        return nearest, distances, away / np.where(norm > 0.0, norm, 1.0)

    def surface_distance(self, points: Array) -> Array:
        """Returns the signed distance (N,) [m] of points (N, 3) [m] to the union of all capsules.

        The distance is exact outside. Inside it is a lower bound of the depth, because part of a
        capsule's surface may be inside another capsule.
        """
        return self._nearest(points)[1]

    def supported(self, axes: AxisPoints, points: Array, near: float) -> NDArray[np.bool_]:
        """Returns whether data lie on the surface beside each sample of the axes, (M,).

        A point belongs to its nearest capsule, and there to the sample nearest to it.

        Args:
            axes: Evenly spaced samples of each axis.
            points: Points in the frame of the capsules, (N, 3) [m].
            near: Distance from the surface at which a point lies on it [m].
        """
        nearest, distances, heights = self._nearest(points)
        lengths = np.linalg.norm(self.ends[:, 1] - self.ends[:, 0], axis=1)
        counts = np.bincount(axes.capsules, minlength=len(self))
        spacings = np.maximum(lengths, 1e-9) / np.maximum(counts - 1, 1)
        on = np.abs(distances) <= near
        own = nearest[on]
        steps = np.minimum(np.rint(heights[on] / spacings[own]).astype(np.intp), counts[own] - 1)
        samples = np.bincount((np.cumsum(counts) - counts)[own] + steps, minlength=len(axes.points))
        return np.asarray(samples > 0)

    def limb_radius(self) -> float:
        """Returns the radius [m] of a typical limb: the median over the capsules' length."""
        radii = self.radii.mean(axis=1)
        lengths = np.linalg.norm(self.ends[:, 1] - self.ends[:, 0], axis=1) + 2.0 * radii
        order = np.argsort(radii)
        half = np.searchsorted(np.cumsum(lengths[order]), 0.5 * lengths.sum())
        return float(radii[order][half])

    def frames(self) -> Array:
        """Returns right-handed axes (C, 3, 3) whose second one has the direction of the capsule's.

        A capsule of no length has the direction y.
        """
        ways = self.ends[:, 1] - self.ends[:, 0]
        lengths = np.linalg.norm(ways, axis=1, keepdims=True)
        units = np.where(
            lengths > 0.0, ways / np.where(lengths > 0.0, lengths, 1.0), [0.0, 1.0, 0.0]
        )
        sides = np.cross(units, np.eye(3)[np.abs(units).argmin(axis=1)])
        sides /= np.linalg.norm(sides, axis=1, keepdims=True)
        return np.stack([sides, units, np.cross(sides, units)], axis=2)

    def axis_points(self, spacing: float) -> AxisPoints:
        """Returns samples of the axes, at most ``spacing`` [m] apart."""
        lengths = np.linalg.norm(self.ends[:, 1] - self.ends[:, 0], axis=1)
        # The tolerance keeps the number of samples independent of the placement.
        return self._on_axes(np.ceil(lengths / spacing - 1e-6).astype(np.intp) + 1)

    def axis_samples(self, count: int) -> AxisPoints:
        """Returns ``count`` evenly spaced samples of each axis, from end to end."""
        return self._on_axes(np.full(len(self), count, dtype=np.intp))

    def axis_parts(self, counts: int | Indices) -> AxisPoints:
        """Returns the middles of ``counts`` equal parts of the axes, one number or (C,)."""
        each = np.broadcast_to(counts, len(self))
        along = np.concatenate([(np.arange(count) + 0.5) / count for count in each])
        return self._at(np.repeat(np.arange(len(self)), each), along)

    def _on_axes(self, counts: Indices) -> AxisPoints:
        """Returns evenly spaced samples of the axes, ``counts`` (C,) of each."""
        capsules = np.repeat(np.arange(len(self)), counts)
        along = np.concatenate([np.linspace(0.0, 1.0, count) for count in counts])
        return self._at(capsules, along)

    def _at(self, capsules: Indices, along: Array) -> AxisPoints:
        """Returns samples ``along`` (M,), from 0 to 1, the axes of capsules (M,)."""
        ends, radii = self.ends[capsules], self.radii[capsules]
        return AxisPoints(
            segments=self.segments[capsules],
            points=ends[:, 0] + along[:, None] * (ends[:, 1] - ends[:, 0]),
            radii=radii[:, 0] + along * (radii[:, 1] - radii[:, 0]),
            capsules=capsules,
            along=along,
        )

    def _nearest(self, points: Array) -> tuple[Indices, Array, Array]:
        """Returns the nearest capsules, signed distances [m] and heights of spheres [m], (N,)."""
        return nearest_capsules(loop_input(points), loop_input(self.ends), loop_input(self.radii))


@dataclass(frozen=True)
class AxisPoints(Brief):
    """M samples of capsule axes, in the frame of the capsules.

    Attributes:
        segments: Index of the segment of each sample, (M,).
        points: Positions, (M, 3) [m].
        radii: Capsule radius at each sample, (M,) [m].
        capsules: Index of the capsule of each sample, (M,).
        along: Position of each sample on its axis, from 0 to 1, (M,).
    """

    segments: Indices
    points: Array
    radii: Array
    capsules: Indices
    along: Array

    def place(self, transforms: Array) -> Array:
        """Returns world positions (..., M, 3) [m] for T_world_segment (..., S, 4, 4)."""
        carriers = transforms[..., self.segments, :, :]
        rotated = (carriers[..., :3, :3] @ self.points[:, :, None])[..., 0]
        return np.asarray(rotated + carriers[..., :3, 3])
