"""Which frames of a track are doubtful, by the data alone."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from regkit.body import Body
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.tracking.track import Track

FEW = 0.5
"""A frame of which a smaller share of the points are inliers is doubtful."""

FAR = 0.05
"""So is one whose points lie farther from the surface, as a part of the body's size."""


NEAR = 0.03
"""A part of the body has data near it within this part of the body's size."""

SPACING = 0.05
"""Distance of the points on a body's axes, as a part of its size."""


def doubtful(track: Track, size: float) -> NDArray[np.bool_]:
    """Returns whether each of T frames is doubtful, (T,): a figure that is unknown raises no doubt.

    Args:
        track: What was found.
        size: Of the body [m].
    """
    return (track.inlier_shares < FEW) | (track.surface_distances > FAR * size)


def unseen(body: Body, pose: Pose, points: Array) -> bool:
    """Whether most of a body has no data near it, as one in place of something much smaller.

    Args:
        body: Its capsules are held against the data; a body without any raises no doubt.
        pose: Of the body.
        points: The data, (N, 3) [m].
    """
    if not len(body.capsules):
        return False
    axes = body.capsules.place(body.place(pose).transforms).axis_points(SPACING * body.size)
    distances, _ = KDTree(points).query(axes.points)
    return bool(np.median(distances - axes.radii) > NEAR * body.size)
