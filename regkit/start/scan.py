"""How a posed body and a cloud differ, seen from both sides."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import KDTree

from regkit.body import Body
from regkit.skeleton import Placement
from regkit.system.arrays import Array, Indices

MOST_POINTS = 400
"""So many points tell a pose as well as all of them do, and sooner."""

SPACING = 0.05
"""Distance of the points on a body's axes, as a part of the body's size."""


@dataclass(frozen=True)
class Gaps:
    """Distances that vanish where a body fits a cloud, and how they change with its motion.

    Attributes:
        lengths: Signed distances, (R,) [m].
        segments: The segment that each belongs to, (R,).
        points: Where it acts, (R, 3) [m].
        directions: Its derivative to a translation of the segment, (R, 3).
    """

    lengths: Array
    segments: Indices
    points: Array
    directions: Array


class Scan:
    """A cloud that bodies can be held against.

    Two sides are looked at: the distances of the points to the body's surface tell what of the data
    the body does not explain; those of the body's axes to the points, beyond the body's own
    thickness, tell what of the body has no data. Neither alone would notice a body of a wrong size.

    Args:
        points: The cloud, (N, 3) [m].
    """

    def __init__(self, points: Array) -> None:
        step = max(1, len(points) // MOST_POINTS)
        self._centre = points.mean(axis=0)
        self._points = points[::step]
        self._tree = KDTree(points)

    def centres(self, size: float) -> list[Array]:
        """Where a body of this size [m] may be: at the centre, or at the ends of a long cloud.

        A hand with its forearm is such a cloud: the forearm is no part of the body that is sought.
        """
        offsets = self._points - self._centre
        axis = np.linalg.svd(offsets, full_matrices=False)[2][0]
        low, high = np.percentile(offsets @ axis, [1.0, 99.0])
        if high - low < 1.2 * size:
            return [self._centre]
        ends = (low + 0.5 * size, high - 0.5 * size)
        return [self._centre, *(self._centre + end * axis for end in ends)]

    def unexplained(self, body: Body, placement: Placement) -> Gaps:
        """From the surface to the points."""
        capsules = body.capsules.place(placement.transforms)
        nearest, distances, away = capsules.nearest(self._points)
        return Gaps(distances, capsules.segments[nearest], self._points, -away)

    def unseen(self, body: Body, placement: Placement) -> Gaps:
        """From the points to the axes, as far as the body does not reach by its thickness."""
        axes = body.capsules.place(placement.transforms).axis_points(SPACING * body.size)
        distances, nearest = self._tree.query(axes.points)
        away = axes.points - self._tree.data[nearest]
        directions = away / np.maximum(distances, 1e-9)[:, None]
        gaps = np.maximum(distances - axes.radii, 0.0)
        return Gaps(gaps, axes.segments, axes.points, directions * (gaps > 0.0)[:, None])

    def misfit(self, body: Body, placement: Placement, reach: float) -> float:
        """How badly a body fits, from 0 to 2: the mean gaps, cut off at ``reach`` [m], over it."""
        sides = (self.unexplained(body, placement), self.unseen(body, placement))
        return sum(float(np.minimum(np.abs(side.lengths), reach).mean()) / reach for side in sides)
