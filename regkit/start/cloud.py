"""The first pose of a rigid cloud: many rotations, each fitted roughly, the best one kept."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from regkit.body import Body
from regkit.clouds import normals
from regkit.geometry.rigid import exp, inverse, rigid, transformed
from regkit.geometry.surface import SkinnedSurface
from regkit.observation import Observation
from regkit.search.rotations import icosahedral
from regkit.skeleton import Pose
from regkit.system.arrays import Array, Indices

SKETCH = 300
"""So many points of the data are fitted from every rotation."""

ROUGH, FINE = 10, 20
"""Steps to closest points from each rotation, and then to planes from those that end nearest."""

FINALISTS = 15
"""How many those are."""

KEPT = 0.8
"""Share of the pairs, the nearest ones, that count in a step."""


def cloud_pose(body: Body, surface: SkinnedSurface, observation: Observation) -> Pose:
    """The pose in which the data lie nearest to a rigid surface, of all that 60 rotations lead to.

    Each is fitted by trimmed closest points (Chetverikov et al., The trimmed iterative closest
    point algorithm, 2002): no method's own way, so that all begin alike.
    """
    points = surface.place(body.place(body.skeleton.rest()).transforms)
    some = observation.points[:: max(1, len(observation.points) // SKETCH)]
    fitting = _Fitting(KDTree(points), points, normals(points), some)
    centre, aim = points.mean(axis=0), some.mean(axis=0)
    rough = [fitting.to_points(rigid(turn, aim - turn @ centre)) for turn in icosahedral()]
    likely = sorted(rough, key=fitting.gap)[:FINALISTS]
    return body.skeleton.rest(min(map(fitting.to_planes, likely), key=fitting.gap))


@dataclass(frozen=True)
class _Fitting:
    """The surface's points and normals (N, 3) at rest, and some of the data (M, 3)."""

    tree: KDTree
    points: Array
    directions: Array
    some: Array

    def to_points(self, transform: Array) -> Array:
        """T_world_body (4, 4) after some steps to closest points."""
        for _ in range(ROUGH):
            nearest, _, kept = self._pairs(transform)
            transform = _between(self.points[nearest], self.some[kept])
        return transform

    def to_planes(self, transform: Array) -> Array:
        """T_world_body (4, 4) after some steps to the planes there (Chen and Medioni, 1992)."""
        for _ in range(FINE):
            nearest, seen, _ = self._pairs(transform)
            planes = self.directions[nearest]
            gaps = (planes * (seen - self.points[nearest])).sum(axis=1)
            rows = np.concatenate([planes, np.cross(seen, planes)], axis=1)
            # The data move against the body; where nothing holds them they stay.
            matrix = rows.T @ rows
            matrix += 1e-9 * np.trace(matrix) * np.eye(6)
            transform = transform @ inverse(exp(-np.linalg.solve(matrix, rows.T @ gaps)))
        return transform

    def _pairs(self, transform: Array) -> tuple[Indices, Array, NDArray[np.bool_]]:
        """The nearest points, the data in the body's frame (both only if kept), and which are."""
        seen = transformed(inverse(transform), self.some)
        distances, nearest = self.tree.query(seen)
        kept = np.asarray(distances <= np.quantile(distances, KEPT))
        return np.asarray(nearest)[kept], seen[kept], kept

    def gap(self, transform: Array) -> float:
        """Returns the root mean square distance [m] of the nearest data to the surface."""
        distances = np.sort(self.tree.query(transformed(inverse(transform), self.some))[0])
        return float(np.sqrt((distances[: int(KEPT * len(distances))] ** 2).mean()))


def _between(source: Array, target: Array) -> Array:
    """Returns the motion (4, 4) of least squares between pairs (N, 3): Kabsch, 1976."""
    middle, aim = source.mean(axis=0), target.mean(axis=0)
    left, _, right = np.linalg.svd((target - aim).T @ (source - middle))
    mirrored = np.diag([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    rotation = left @ mirrored @ right
    return rigid(rotation, aim - rotation @ middle)
