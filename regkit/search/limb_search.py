"""Search for a limb among sampled configurations by the data that the rest does not explain."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy

from regkit.body import Body
from regkit.geometry.capsules import AxisPoints, Capsules
from regkit.observation.silhouette import Silhouette
from regkit.search.compiled import mean_gaps
from regkit.search.limbs import Limb, limbs_of
from regkit.skeleton import Placement, Pose
from regkit.system.arrays import Array

SPACING = 0.05
"""Distance of the points on a limb's axis, as a fraction of the body's size."""

MOST_POINTS, FEWEST_POINTS = 24, 3
"""Maximum number of unexplained points to compare, and the minimum that shows where a limb is."""

LIKELY = 30
"""Number of configurations, best for the unexplained points, that are compared with all points."""

BETTER = 0.9
"""A configuration is worth a try if its misfit is below this fraction of the current misfit."""


@dataclass(frozen=True)
class LimbSearch:
    """Sampled configurations of a limb.

    Attributes:
        body: The body with the limb.
        limb: The limb.
        axes: Points on the limb's axis.
        rest: Capsules of the rest of the body.
        balls: Quaternions of the ball joints in N configurations, (N, n_ball, 4).
        hinges: Hinge angles in these configurations, (N, n_hinge) [rad].
        places: The axis points in the frame of the limb's parent segment, (N, P, 3) [m].
    """

    body: Body
    limb: Limb
    axes: AxisPoints
    rest: Capsules
    balls: Array
    hinges: Array
    places: Array

    @classmethod
    def of_all(cls, body: Body, random: np.random.Generator, samples: int) -> Iterator[LimbSearch]:
        """Yields a search for each of a body's limbs.

        Args:
            body: The body.
            random: Source of the configurations.
            samples: Number N of configurations within the joint limits.
        """
        rest = body.skeleton.rest()
        balls, hinges = body.skeleton.limits.sampled(random, samples)
        for limb in limbs_of(body.skeleton):
            own = np.isin(body.capsules.segments, limb.segments)
            if not own.any():
                continue
            poses = limb.rotated(rest, balls, hinges)
            axes = body.capsules.selected(own).axis_points(SPACING * body.size)
            transforms = Placement.of(body.skeleton, poses).transforms
            places = axes.place(transforms) - transforms[:, limb.parent, None, :3, 3]
            places = places @ transforms[:, limb.parent, :3, :3]
            yield cls(body, limb, axes, body.capsules.selected(~own), balls, hinges, places)

    def starts(
        self,
        cloud: scipy.spatial.KDTree,
        pose: Pose,
        most: int,
        silhouette: Silhouette | None = None,
    ) -> Iterator[Pose]:
        """Yields up to ``most`` poses whose limb best covers what the rest leaves unexplained.

        Args:
            cloud: The frame's points [m].
            pose: Pose of the body, in which the limb is in doubt.
            most: Maximum number of poses.
            silhouette: What the frame's picture shows: a limb out of the picture is not absent.
        """
        placement = self.body.place(pose)
        carrier = placement.transforms[self.limb.parent]
        places = self.places @ carrier[:3, :3].T + carrier[:3, 3]
        bare = self._bare(np.asarray(cloud.data), placement, places[0, 0])
        if len(bare) < FEWEST_POINTS:
            return
        present = self.axes.place(placement.transforms)[None]
        now = (
            self._data_to_model(present, bare) + self._model_to_data(present, cloud, silhouette)
        )[0]
        uncovered = self._data_to_model(places, bare)
        likely = np.argsort(uncovered)[:LIKELY]
        misfits = uncovered[likely] + self._model_to_data(places[likely], cloud, silhouette)
        for index in np.argsort(misfits)[:most]:
            if misfits[index] < BETTER * now:
                chosen = likely[index]
                yield self.limb.rotated(pose, self.balls[chosen], self.hinges[chosen])

    def _bare(self, points: Array, placement: Placement, root: Array) -> Array:
        """Returns points within the limb's length that the rest of the body does not explain."""
        length = float(np.linalg.norm(self.places - self.places[:, :1], axis=2).max())
        near = points[np.linalg.norm(points - root, axis=1) < 1.2 * length]
        if len(self.rest):
            rest = self.rest.place(placement.transforms)
            near = near[rest.surface_distance(near) > float(self.axes.radii.max())]
        return np.ascontiguousarray(near[:: max(1, len(near) // MOST_POINTS)])

    def _data_to_model(self, places: Array, bare: Array) -> Array:
        """Returns the misfit (N,) of the unexplained points to the limb's surface."""
        return mean_gaps(places, self.axes.radii, bare, self._cutoff)

    def _model_to_data(
        self, places: Array, cloud: scipy.spatial.KDTree, silhouette: Silhouette | None
    ) -> Array:
        """Returns the misfit (N,) of the limb's surface to the points."""
        gaps = np.maximum(cloud.query(places)[0] - self.axes.radii, 0.0)
        if silhouette is not None:
            gaps *= silhouette.observable(places.reshape(-1, 3)).reshape(gaps.shape)
        return np.asarray(np.minimum(gaps, self._cutoff).mean(axis=1) / self._cutoff)

    @property
    def _cutoff(self) -> float:
        """Upper bound of a distance, the limb's width [m]."""
        return 2.0 * float(self.axes.radii.max())
