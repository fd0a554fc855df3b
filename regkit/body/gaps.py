"""Distances of points to the surface of a posed body."""

from __future__ import annotations

import numpy as np
import scipy

from regkit.body.body import Body
from regkit.skeleton import Pose
from regkit.system.arrays import Array, loop_input


def surface_gaps(body: Body, pose: Pose, points: Array) -> Array | None:
    """Returns the distances of points (N, 3) to a body's surface, (N,) [m]; None without one."""
    transforms = body.place(pose).transforms
    if len(body.capsules):
        placed = body.capsules.place(transforms)
        return np.abs(placed.surface_distance(loop_input(points)))
    if body.surface is not None:
        placed_points = body.surface.place(transforms)
        return np.asarray(scipy.spatial.KDTree(placed_points).query(points)[0])
    return None
