"""Doubtful frames of a track, judged by the data alone."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from regkit.body import Body
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.tracking.track import Track

FEW = 0.5
"""A frame with a smaller share of inliers is doubtful."""

FAR = 0.05
"""A frame is doubtful if its points are farther from the surface, as a fraction of the size."""


NEAR = 0.03
"""A part of the body is seen if data lie within this fraction of the body's size."""

SPACING = 0.05
"""Distance of the points on a body's axes, as a fraction of its size."""


def doubtful(track: Track, size: float) -> NDArray[np.bool_]:
    """Returns whether each of T frames is doubtful, (T,); unknown values raise no doubt.

    Args:
        track: The track.
        size: Size of the body [m].
    """
    return (track.inlier_shares < FEW) | (track.surface_distances > FAR * size)


def unseen(body: Body, pose: Pose, points: Array) -> bool:
    """Returns whether most of a body has no data near it, as if it replaced a much smaller thing.

    Args:
        body: The body; without capsules it raises no doubt.
        pose: Pose of the body.
        points: The data, (N, 3) [m].
    """
    if not len(body.capsules):
        return False
    axes = body.capsules.place(body.place(pose).transforms).axis_points(SPACING * body.size)
    distances, _ = KDTree(points).query(axes.points)
    return bool(np.median(distances - axes.radii) > NEAR * body.size)
