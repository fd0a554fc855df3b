"""The first pose of a rigid cloud: the best of many rotations, each fitted roughly."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from regkit.body import Body
from regkit.clouds import normals
from regkit.geometry.rigid import exp, inverse, rigid, transformed
from regkit.geometry.surface import SkinnedSurface
from regkit.observation import Observation
from regkit.search.rotations import icosahedral
from regkit.skeleton import Pose
from regkit.system.arrays import Array, Indices

SKETCH = 300
"""Number of data points that are fitted from every rotation."""

ROUGH, FINE = 10, 20
"""Number of point-to-point steps from each rotation, and of point-to-plane steps of finalists."""

FINALISTS = 15
"""Number of rotations, those that end nearest, that are refined point-to-plane."""

KEPT = 0.8
"""Fraction of the pairs, the nearest ones, that a step uses."""


def cloud_pose(body: Body, surface: SkinnedSurface, observation: Observation) -> Pose:
    """Returns the best pose of a rigid surface over fits from 60 rotations.

    Each is fitted by trimmed iterative closest points (Chetverikov et al., The trimmed iterative
    closest point algorithm, 2002). The start does not depend on the method, so that all methods
    begin alike.

    Args:
        body: The rigid body.
        surface: Its surface.
        observation: The data.
    """
    points = surface.place(body.place(body.skeleton.rest()).transforms)
    sample = observation.points[:: max(1, len(observation.points) // SKETCH)]
    fitting = _Fitting(scipy.spatial.KDTree(points), points, normals(points), sample)
    centre, aim = points.mean(axis=0), sample.mean(axis=0)
    rough = [
        fitting.to_points(rigid(rotation, aim - rotation @ centre)) for rotation in icosahedral()
    ]
    likely = sorted(rough, key=fitting.gap)[:FINALISTS]
    return body.skeleton.rest(min(map(fitting.to_planes, likely), key=fitting.gap))


@dataclass(frozen=True)
class _Fitting:
    """The surface's points and normals (N, 3) at rest, and a subset of the data (M, 3)."""

    tree: scipy.spatial.KDTree
    points: Array
    directions: Array
    sample: Array

    def to_points(self, transform: Array) -> Array:
        """Returns T_world_body (4, 4) after point-to-point steps."""
        for _ in range(ROUGH):
            nearest, _, kept = self._pairs(transform)
            transform = _rigid_fit(self.points[nearest], self.sample[kept])
        return transform

    def to_planes(self, transform: Array) -> Array:
        """Returns T_world_body (4, 4) after point-to-plane steps (Chen and Medioni, 1992)."""
        for _ in range(FINE):
            nearest, seen, _ = self._pairs(transform)
            planes = self.directions[nearest]
            gaps = (planes * (seen - self.points[nearest])).sum(axis=1)
            rows = np.concatenate([planes, np.cross(seen, planes)], axis=1)
            # The step moves the data against the body; it is zero in undetermined directions.
            matrix = rows.T @ rows
            matrix += 1e-9 * np.trace(matrix) * np.eye(6)
            transform = transform @ inverse(exp(-np.linalg.solve(matrix, rows.T @ gaps)))
        return transform

    def _pairs(self, transform: Array) -> tuple[Indices, Array, NDArray[np.bool_]]:
        """Returns nearest points and data in the body's frame, both trimmed, and the mask."""
        seen = transformed(inverse(transform), self.sample)
        distances, nearest = self.tree.query(seen)
        kept = np.asarray(distances <= np.quantile(distances, KEPT))
        return np.asarray(nearest)[kept], seen[kept], kept

    def gap(self, transform: Array) -> float:
        """Returns the root mean square distance of the trimmed data to the surface [m]."""
        distances = np.sort(self.tree.query(transformed(inverse(transform), self.sample))[0])
        return float(np.sqrt((distances[: int(KEPT * len(distances))] ** 2).mean()))


def _rigid_fit(source: Array, target: Array) -> Array:
    """Returns the least-squares rigid motion (4, 4) between pairs (N, 3) (Kabsch, 1976)."""
    middle, aim = source.mean(axis=0), target.mean(axis=0)
    left, _, right = np.linalg.svd((target - aim).T @ (source - middle))
    mirrored = np.diag([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    rotation = left @ mirrored @ right
    return rigid(rotation, aim - rotation @ middle)
