"""The start that an oracle would give: the pose whose markers are nearest to the true joints.

With `--start truth` the tables show what the method makes of the data from there, which no search
for a start can exceed by much.
"""

from __future__ import annotations

import numpy as np
from _starts_shots import Shots

from regkit.geometry.rigid import rigid
from regkit.interfaces import Start, Template
from regkit.metrics.matching import matched
from regkit.observation import Truth
from regkit.system.arrays import Array

STEPS, DAMPING = 60, 1e-3
"""Number of Gauss-Newton steps, and their damping relative to the body's size."""


def true_start(template: Template, shots: Shots) -> Start:
    """Returns the start in the first frame for a template of known size."""
    body = template.body(template.candidate_sizes()[0])
    skeleton, goal = body.skeleton, shots.truth[0]
    _, chosen = matched(body, Truth(shots.joints, shots.truth[:1]), {})
    segments = body.markers.segments[chosen]
    at_rest = body.markers.place(body.place(skeleton.rest()).transforms)[chosen]
    pose, directions = skeleton.rest(_aligned(at_rest, goal)), np.eye(3)
    for _ in range(STEPS):
        placement = body.place(pose)
        places = body.markers.place(placement.transforms)[chosen]
        rows = np.concatenate([
            placement.rows(segments, places, np.broadcast_to(axis, places.shape))
            for axis in directions
        ])  # fmt: skip
        gaps = (goal - places).T.ravel()
        matrix = rows.T @ rows + (DAMPING * body.size) ** 2 * np.eye(rows.shape[1])
        pose = skeleton.limits.projected(
            skeleton.retract(pose, np.linalg.solve(matrix, rows.T @ gaps))
        )
    return Start(body, pose)


def _aligned(points: Array, goal: Array) -> Array:
    """Returns the least-squares rigid motion (4, 4) between pairs of points (N, 3) [m]."""
    middle, aim = points.mean(axis=0), goal.mean(axis=0)
    left, _, right = np.linalg.svd((goal - aim).T @ (points - middle))
    rotation = left @ np.diag([1.0, 1.0, np.sign(np.linalg.det(left @ right))]) @ right
    return rigid(rotation, aim - rotation @ middle)
