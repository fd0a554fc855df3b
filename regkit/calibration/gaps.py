"""Gaps between a posed body and a frame's data, seen from both sides."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import KDTree

from regkit.geometry.capsules import Capsules
from regkit.observation import Observation
from regkit.system.arrays import Array, Indices

MOST_POINTS = 500
"""So many points of a frame tell its proportions as well as all of them do."""

AXIS_POINTS = 5
"""How many points of each capsule's axis are looked at."""

STEPS = 15
"""How many steps are taken along a ray, each as long as the surface is far."""


@dataclass(frozen=True)
class Gaps:
    """Distances of data to spheres on the axes of capsules, which vanish where the body fits.

    Attributes:
        capsules: The capsule of each, (R,).
        along: Where on its axis the sphere is, from 0 to 1, (R,).
        centres: The spheres' centres, (R, 3) [m].
        directions: The way from the centre in which the gap is measured, (R, 3): a unit vector, or
            zero where the gap is closed and stays so.
        lengths: Distances from the spheres along these ways, (R,) [m].
        weights: (R,), of sum one at most.
    """

    capsules: Indices
    along: Array
    centres: Array
    directions: Array
    lengths: Array
    weights: Array


@dataclass(frozen=True)
class Cloud:
    """One frame's data.

    The distances of points to the surface tell what of the data the body does not explain; those of
    the axes to the points, beyond the body's own thickness, tell what of the body has no data.

    Attributes:
        observation: The data.
        points: Some of its points, (N, 3) [m].
        tree: All of its points.
    """

    observation: Observation
    points: Array
    tree: KDTree

    @classmethod
    def of(cls, observation: Observation) -> Cloud:
        """The cloud of a frame."""
        step = max(1, -(-len(observation.points) // MOST_POINTS))
        return cls(observation, observation.points[::step], KDTree(observation.points))

    def unexplained(self, capsules: Capsules, reach: float) -> Gaps:
        """From the surface to the points, whose noise lies along their rays.

        A point belongs where its ray meets the surface within ``reach`` [m], and is held against
        the plane there, so that its noise has no say in where it belongs. Held against the nearest
        surface, noise of 2 cm makes a person's shins thinner by 7 %.
        """
        met = self.points
        if self.observation.camera is not None:
            met = _met(self.points, capsules, reach)
        nearest, distances, directions = capsules.nearest(met)
        start, end = capsules.ends[nearest, 0], capsules.ends[nearest, 1]
        first, last = capsules.radii[nearest].T
        # The sphere's centre is on the axis, and its radius and the distance before the point met.
        axis, widening = end - start, last - first
        reached = met - start - (distances + first)[:, None] * directions
        square = np.maximum((axis**2).sum(axis=1), 1e-12)
        along = (reached * axis).sum(axis=1) / (square + widening * (directions * axis).sum(axis=1))
        along = np.clip(along, 0.0, 1.0)
        return Gaps(
            capsules=nearest,
            along=along,
            centres=start + along[:, None] * axis,
            directions=directions,
            lengths=distances + ((self.points - met) * directions).sum(axis=1),
            weights=np.full(len(met), 1.0 / len(met)),
        )

    def unseen(self, capsules: Capsules) -> Gaps:
        """From spheres on the axes to the nearest points, where nothing hides the spheres."""
        along = np.tile(np.linspace(0.0, 1.0, AXIS_POINTS), len(capsules))
        own = np.repeat(np.arange(len(capsules)), AXIS_POINTS)
        ends, radii = capsules.ends[own], capsules.radii[own]
        centres = ends[:, 0] + along[:, None] * (ends[:, 1] - ends[:, 0])
        thick = radii[:, 0] + along * (radii[:, 1] - radii[:, 0])
        distances, nearest = self.tree.query(centres)
        lengths = np.maximum(distances - thick, 0.0)
        ways = np.asarray(self.tree.data)[nearest] - centres
        directions = ways * ((lengths > 0.0) / np.maximum(distances, 1e-9))[:, None]
        weights = (1.0 - self._hidden(centres, thick)) / len(along)
        return Gaps(own, along, centres, directions, lengths, weights)

    def _hidden(self, centres: Array, thick: Array) -> Array:
        """One where the camera saw something that is well before a sphere, else zero, (R,)."""
        camera, depth = self.observation.camera, self.observation.depth
        if camera is None or depth is None:
            return np.zeros(len(centres))
        columns, rows = np.rint(camera.projected(centres)).astype(np.intp).T
        inside = (columns >= 0) & (columns < camera.width) & (rows >= 0) & (rows < camera.height)
        measured = np.zeros(len(centres))
        measured[inside] = depth[rows[inside], columns[inside]]
        before = (measured > 0.0) & (measured < centres[:, 2] - 2.0 * thick)
        return before.astype(np.float64)


def _met(points: Array, capsules: Capsules, reach: float) -> Array:
    """Where the rays of points from the origin meet a surface, or come nearest to it, (N, 3) [m].

    Each ray is looked at within ``reach`` [m] of its point. The point itself stands for a ray that
    begins beneath the surface, for then something else is in the way.
    """
    rays = points / np.linalg.norm(points, axis=1, keepdims=True)
    at = np.full(len(points), -reach)
    distances = capsules.surface_distance(points + at[:, None] * rays)
    best, least = np.where(distances > 0.0, at, 0.0), distances.copy()
    going = np.flatnonzero(distances > 0.0)
    for _ in range(STEPS):
        at[going] = np.minimum(at[going] + distances[going], reach)
        some = rays[going]
        distances[going] = capsules.surface_distance(points[going] + at[going, None] * some)
        nearer = going[distances[going] < least[going]]
        best[nearer], least[nearer] = at[nearer], distances[nearer]
        going = going[(distances[going] > _TOUCHED * reach) & (at[going] < reach)]
    return np.asarray(points + best[:, None] * rays)


_TOUCHED = 0.01
"""A ray that comes so near, as a part of the reach, has met the surface."""
