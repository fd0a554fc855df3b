"""A point cloud and its distances to bodies."""

from __future__ import annotations

import numpy as np
import scipy

from regkit.body import Body
from regkit.body.distance import SurfaceDistances, data_to_model, model_to_data
from regkit.observation import Observation
from regkit.observation.sight import Sight
from regkit.skeleton import Placement
from regkit.system.arrays import Array

MOST_POINTS = 400
"""This many points determine a pose as well as all of them, and faster."""

SPACING = 0.05
"""Distance of the points on a body's axes, as a fraction of the body's size."""


class Scan:
    """A cloud and its two-sided distance to posed bodies.

    Parts of a body that the camera cannot show are not absent: what is beyond the picture, or on
    unknown pixels, has no distance to the data.

    Args:
        points: The cloud, (N, 3) [m].
        sight: What the cameras show; None if everything is seen.
    """

    def __init__(self, points: Array, sight: Sight | None = None) -> None:
        step = max(1, len(points) // MOST_POINTS)
        self._centre = points.mean(axis=0)
        self._points = points[::step]
        self._tree = scipy.spatial.KDTree(points)
        self._sight = sight

    @classmethod
    def of(cls, observation: Observation) -> Scan:
        """Returns the cloud of a frame."""
        return cls(observation.points, observation.sight)

    def centres(self, size: float) -> list[Array]:
        """Returns possible centres (3,) of a body of this size [m].

        They are the cloud's centre and, for a long cloud, places near its ends: the cloud of a hand
        may include the forearm, which is not part of the body.
        """
        offsets = self._points - self._centre
        axis = np.linalg.svd(offsets, full_matrices=False)[2][0]
        low, high = np.percentile(offsets @ axis, [1.0, 99.0])
        if high - low < 1.2 * size:
            return [self._centre]
        ends = (low + 0.5 * size, high - 0.5 * size)
        return [self._centre, *(self._centre + end * axis for end in ends)]

    def distances(
        self, body: Body, placement: Placement
    ) -> tuple[SurfaceDistances, SurfaceDistances]:
        """Returns the distances of the data to the body, and of the body to the data."""
        capsules = body.capsules.place(placement.transforms)
        axes = body.required.place(placement.transforms).axis_points(SPACING * body.size)
        seen = None if self._sight is None else self._sight.observable(axes.points)
        return data_to_model(capsules, self._points), model_to_data(axes, self._tree, seen)

    def misfit(self, body: Body, placement: Placement, cutoff: float) -> float:
        """Returns the sum of both sides' mean distances in units of the cutoff, from 0 to 2.

        Args:
            body: The body.
            placement: Its placement.
            cutoff: Upper bound of each distance [m].
        """
        return sum(
            float(np.minimum(np.abs(side.lengths), cutoff).sum()) / max(side.count, 1) / cutoff
            for side in self.distances(body, placement)
        )
