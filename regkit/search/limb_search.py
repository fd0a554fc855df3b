"""Where else a limb could be: its configurations held against what the rest of a body explains."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.spatial import KDTree

from regkit.body import Body
from regkit.geometry.capsules import AxisPoints, Capsules
from regkit.search.compiled import mean_gaps
from regkit.search.limbs import Limb, limbs_of
from regkit.skeleton import Placement, Pose
from regkit.system.arrays import Array

SPACING = 0.05
"""Distance of the points on a limb's axis, as a part of the body's size."""

MOST_POINTS, FEWEST_POINTS = 24, 3
"""So many bare points tell where a limb is; fewer tell nothing."""

LIKELY = 30
"""How many configurations that cover the bare points are held against all points."""

BETTER = 0.9
"""What a configuration may have of the present misfit, to be worth a try."""


@dataclass(frozen=True)
class LimbSearch:
    """Configurations of a limb, drawn once.

    Attributes:
        body: Whose limb it is.
        limb: The limb.
        axes: Points on the limb's axis.
        rest: The surface of the rest of the body.
        balls: Joints of each of N configurations, (N, n_ball, 4).
        hinges: And their hinges, (N, n_hinge) [rad].
        places: The points in the frame of the segment that the limb hangs on, (N, P, 3) [m].
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
        """Returns a search for each of a body's limbs, with so many configurations."""
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

    def starts(self, cloud: KDTree, pose: Pose, most: int) -> Iterator[Pose]:
        """Returns the poses, at most so many, whose limb covers best what the rest leaves bare.

        Args:
            cloud: The frame's points [m].
            pose: Of the body; that of the limb is in doubt.
            most: How many are wanted.
        """
        placement = self.body.place(pose)
        carrier = placement.transforms[self.limb.parent]
        places = self.places @ carrier[:3, :3].T + carrier[:3, 3]
        bare = self._bare(np.asarray(cloud.data), placement, places[0, 0])
        if len(bare) < FEWEST_POINTS:
            return
        present = self.axes.place(placement.transforms)[None]
        now = (self._data_to_model(present, bare) + self._model_to_data(present, cloud))[0]
        uncovered = self._data_to_model(places, bare)
        likely = np.argsort(uncovered)[:LIKELY]
        misfits = uncovered[likely] + self._model_to_data(places[likely], cloud)
        for index in np.argsort(misfits)[:most]:
            if misfits[index] < BETTER * now:
                chosen = likely[index]
                yield self.limb.rotated(pose, self.balls[chosen], self.hinges[chosen])

    def _bare(self, points: Array, placement: Placement, root: Array) -> Array:
        """Returns the points within the limb's reach that the rest of the body does not explain."""
        length = float(np.linalg.norm(self.places - self.places[:, :1], axis=2).max())
        near = points[np.linalg.norm(points - root, axis=1) < 1.2 * length]
        if len(self.rest):
            rest = self.rest.place(placement.transforms)
            near = near[rest.surface_distance(near) > float(self.axes.radii.max())]
        return np.asarray(near[:: max(1, len(near) // MOST_POINTS)])

    def _data_to_model(self, places: Array, bare: Array) -> Array:
        """How far the bare points are from the limb's surface, in each of N places, (N,)."""
        return mean_gaps(places, self.axes.radii, bare, self._cutoff)

    def _model_to_data(self, places: Array, cloud: KDTree) -> Array:
        """How far the limb's surface is from the points, in each of N places, (N,)."""
        gaps = np.maximum(cloud.query(places)[0] - self.axes.radii, 0.0)
        return np.asarray(np.minimum(gaps, self._cutoff).mean(axis=1) / self._cutoff)

    @property
    def _cutoff(self) -> float:
        """No gap counts more than the limb's width [m]."""
        return 2.0 * float(self.axes.radii.max())
