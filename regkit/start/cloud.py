"""The first pose of a rigid cloud: many rotations, each fitted roughly, the best one kept."""

from __future__ import annotations

import numpy as np
from scipy.spatial import KDTree

from regkit.alignment.rotations import icosahedral
from regkit.arrays import Array
from regkit.body import Body
from regkit.observation import Observation
from regkit.rigid import inverse, moved, rigid
from regkit.skeleton import Pose
from regkit.surface import SkinnedSurface

SKETCH = 300
"""So many points of the data are fitted from every rotation."""

STEPS = 15
"""Steps of closest points from each rotation."""

KEPT = 0.8
"""Share of the pairs, the nearest ones, that count in a step."""


def cloud_pose(body: Body, surface: SkinnedSurface, observation: Observation) -> Pose:
    """The pose in which the data lie nearest to a rigid surface, of all that 60 rotations lead to.

    Each is fitted by trimmed closest points (Chetverikov et al., The trimmed iterative closest
    point algorithm, 2002): no method's own way, so that all begin alike.
    """
    points = surface.place(body.place(body.skeleton.rest()).transforms)
    some = observation.points[:: max(1, len(observation.points) // SKETCH)]
    tree, centre, aim = KDTree(points), points.mean(axis=0), some.mean(axis=0)
    best, least = np.eye(4), np.inf
    for rotation in icosahedral():
        transform = rigid(rotation, aim - rotation @ centre)
        for _ in range(STEPS):
            distances, nearest = tree.query(moved(inverse(transform), some))
            kept = distances <= np.quantile(distances, KEPT)
            transform = _between(points[np.asarray(nearest)[kept]], some[kept])
        gap = float(np.quantile(tree.query(moved(inverse(transform), some))[0], KEPT))
        if gap < least:
            best, least = transform, gap
    return body.skeleton.rest(best)


def _between(source: Array, target: Array) -> Array:
    """The motion (4, 4) of least squares between pairs (N, 3): Kabsch, 1976."""
    middle, aim = source.mean(axis=0), target.mean(axis=0)
    left, _, right = np.linalg.svd((target - aim).T @ (source - middle))
    mirrored = np.diag([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    rotation = left @ mirrored @ right
    return rigid(rotation, aim - rotation @ middle)
