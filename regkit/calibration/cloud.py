"""The data of one frame, and their two-sided distance to a body that is being calibrated."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import KDTree

from regkit.body.distance import SurfaceDistances, data_to_model, model_to_data
from regkit.geometry.capsules import Capsules
from regkit.observation import Observation
from regkit.system.arrays import Array

MOST_POINTS = 500
"""Proportions follow from this many points of a frame as well as from all of them."""

AXIS_POINTS = 5
"""Number of spheres on each capsule's axis."""

STEPS = 15
"""Number of sphere-tracing steps along a ray."""


@dataclass(frozen=True)
class Cloud:
    """One frame's data.

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
        """Returns the cloud of a frame."""
        step = max(1, -(-len(observation.points) // MOST_POINTS))
        return cls(observation, observation.points[::step], KDTree(observation.points))

    def data_to_model(self, capsules: Capsules, span: float) -> SurfaceDistances:
        """Distances of the points to the surface, whose noise lies along their rays.

        A point belongs where its ray meets the surface within ``span`` [m], and its distance is
        that to the tangent plane there, so that its noise has no influence on where it belongs.
        With the distance to the nearest surface, noise of 2 cm makes a person's shins thinner by
        7 %.
        """
        if self.observation.camera is None:
            return data_to_model(capsules, self.points)
        return data_to_model(capsules, self.points, _met(self.points, capsules, span))

    def model_to_data(self, capsules: Capsules) -> tuple[SurfaceDistances, Array]:
        """Distances of spheres on the axes to the nearest points, and their weights (R,).

        A sphere that the camera cannot see has the weight zero; the weights sum to one at most.
        """
        axes = capsules.axis_samples(AXIS_POINTS)
        weights = (1.0 - self._hidden(axes.points, axes.radii)) / len(axes.along)
        return model_to_data(axes, self.tree), weights

    def _hidden(self, centres: Array, thick: Array) -> Array:
        """Returns one where the camera measured well before a sphere, else zero, (R,)."""
        camera, depth = self.observation.camera, self.observation.depth
        if camera is None or depth is None:
            return np.zeros(len(centres))
        columns, rows = np.rint(camera.projected(centres)).astype(np.intp).T
        inside = (columns >= 0) & (columns < camera.width) & (rows >= 0) & (rows < camera.height)
        measured = np.zeros(len(centres))
        measured[inside] = depth[rows[inside], columns[inside]]
        before = (measured > 0.0) & (measured < centres[:, 2] - 2.0 * thick)
        return before.astype(np.float64)


def _met(points: Array, capsules: Capsules, span: float) -> Array:
    """Where the rays of points from the origin meet a surface, or come nearest to it, (N, 3) [m].

    Each ray is traced within ``span`` [m] of its point. A ray that begins beneath the surface is
    occluded by another part, and its point stays.
    """
    rays = points / np.linalg.norm(points, axis=1, keepdims=True)
    at = np.full(len(points), -span)
    distances = capsules.surface_distance(points + at[:, None] * rays)
    best, least = np.where(distances > 0.0, at, 0.0), distances.copy()
    going = np.flatnonzero(distances > 0.0)
    for _ in range(STEPS):
        at[going] = np.minimum(at[going] + distances[going], span)
        some = rays[going]
        distances[going] = capsules.surface_distance(points[going] + at[going, None] * some)
        nearer = going[distances[going] < least[going]]
        best[nearer], least[nearer] = at[nearer], distances[nearer]
        going = going[(distances[going] > _TOUCHED * span) & (at[going] < span)]
    return np.asarray(points + best[:, None] * rays)


_TOUCHED = 0.01
"""A ray that comes so near, as a part of the span, has met the surface."""
