"""Search for a limb among sampled configurations by the data that the rest does not explain."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from regkit.body import Body
from regkit.clouds.compiled_nearest import nearest_distances
from regkit.geometry.capsules import AxisPoints, Capsules
from regkit.observation.sight import Sight
from regkit.search.compiled import mean_gaps, unexplained
from regkit.search.limbs import Limb, limbs_of, part_limbs_of
from regkit.skeleton import Placement, Pose
from regkit.system.arrays import Array, Singles, loop_input

SPACING = 0.05
"""Distance of the points on a limb's axis, as a fraction of the size of its part of the body."""

MOST_POINTS, FEWEST_POINTS = 24, 3
"""Maximum number of unexplained points to compare, and the minimum that shows where a limb is."""

BESIDE = 1.3
"""Distance from a part's joint within which points are beside the part, in sizes of the part."""

SHAKE = 0.2
"""Standard deviation of the joints of a part about its stances [rad or m]."""

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
        places: The axis points in the frame of the limb's parent segment, (P, 3, N) [m].
    """

    body: Body
    limb: Limb
    axes: AxisPoints
    rest: Capsules
    balls: Array
    hinges: Array
    places: Singles

    @classmethod
    def of_all(cls, body: Body, random: np.random.Generator, samples: int) -> Iterator[LimbSearch]:
        """Yields a search for each of a body's limbs.

        Args:
            body: The body.
            random: Source of the configurations.
            samples: Number N of configurations within the joint limits.
        """
        balls, hinges = body.skeleton.limits.sampled(random, samples)
        for limb in limbs_of(body):
            yield from cls._of(body, limb, balls, hinges)

    @classmethod
    def of_parts(
        cls, body: Body, random: np.random.Generator, samples: int
    ) -> Iterator[LimbSearch]:
        """Yields a search for each attached part as a whole.

        It is turned anywhere, in one of its stances, whose joints are shaken.

        Args:
            body: The body.
            random: Source of the configurations.
            samples: Number N of configurations.
        """
        skeleton = body.skeleton
        stances = [stance.pose for stance in body.stances] or [skeleton.rest()]
        for part, limb in zip(body.attached_parts, part_limbs_of(body), strict=True):
            balls, hinges = skeleton.limits.sampled(random, samples)
            joint = skeleton.joint_dofs.get(skeleton.names[part.segments[0]], ())
            inner = np.setdiff1d(part.dofs, joint)
            step = np.zeros(skeleton.dofs)
            for index in range(samples):
                anywhere = Pose(np.eye(4), balls[index], hinges[index])
                stance = stances[random.integers(len(stances))]
                step[inner] = skeleton.difference(anywhere, stance)[inner]
                step[inner] += SHAKE * random.normal(size=len(inner))
                pose = skeleton.limits.projected(skeleton.retract(anywhere, step))
                balls[index], hinges[index] = pose.balls, pose.hinges
            yield from cls._of(body, limb, balls, hinges)

    @classmethod
    def _of(cls, body: Body, limb: Limb, balls: Array, hinges: Array) -> Iterator[LimbSearch]:
        """Yields the search of a limb among configurations; none if it has no surface."""
        own = np.isin(body.capsules.segments, limb.segments)
        if not own.any():
            return
        poses = limb.rotated(body.skeleton.rest(), balls, hinges)
        size = body.part_size(int(limb.segments[0]))
        axes = body.capsules.selected(own).axis_points(SPACING * size)
        transforms = Placement.of(body.skeleton, poses).transforms
        places = axes.place(transforms) - transforms[:, limb.parent, None, :3, 3]
        places = places @ transforms[:, limb.parent, :3, :3]
        singles = np.ascontiguousarray(places.transpose(1, 2, 0), dtype=np.float32)
        rest = body.capsules.selected(~own)
        yield cls(body, limb, axes, rest, balls, hinges, singles)

    def starts(
        self, points: Array, pose: Pose, most: int, sight: Sight | None = None
    ) -> Iterator[Pose]:
        """Yields up to ``most`` poses whose limb best covers what the rest leaves unexplained.

        Args:
            points: The frame's points, (N, 3) [m].
            pose: Pose of the body, in which the limb is in doubt.
            most: Maximum number of poses.
            sight: What the cameras show: a limb out of the picture is not absent.
        """
        points, transforms = loop_input(points), self.body.place(pose).transforms
        rotation, origin = transforms[self.limb.parent, :3, :3], transforms[self.limb.parent, :3, 3]
        root = rotation @ self.places[0, :, 0] + origin
        bare = self._bare(points, transforms, root)
        if len(bare) < FEWEST_POINTS:
            return
        present = self.axes.place(transforms)[None]
        now = self._data_to_model(present.transpose(1, 2, 0), bare)
        now += self._model_to_data(present, points, sight)
        uncovered = self._data_to_model(self.places, (bare - origin) @ rotation)
        likely = np.argsort(uncovered)[:LIKELY]
        places = self.places[:, :, likely].transpose(2, 0, 1) @ rotation.T + origin
        misfits = uncovered[likely] + self._model_to_data(places, points, sight)
        for index in np.argsort(misfits)[:most]:
            if misfits[index] < BETTER * now[0]:
                chosen = likely[index]
                yield self.limb.rotated(pose, self.balls[chosen], self.hinges[chosen])

    def beside(self, points: Array, pose: Pose) -> NDArray[np.bool_] | slice:
        """Returns which points (N, 3) [m] are beside the part of the body with the limb, (N,).

        Those of a body that is no part, or carries others, are all.
        """
        first = int(self.limb.segments[0])
        for part in self.body.attached_parts:
            if self.limb.parent in part.segments or first == part.segments[0]:
                origin = self.body.place(pose).transforms[part.segments[0], :3, 3]
                distances = np.linalg.norm(points - origin, axis=1)
                return np.asarray(distances < BESIDE * part.size)
        return slice(None)

    def _bare(self, points: Array, transforms: Array, root: Array) -> Array:
        """Returns points within the limb's length that the rest of the body does not explain."""
        rest, width = self.rest.place(transforms), 0.5 * self._cutoff
        bare = unexplained(points, root, 1.2 * self._length, rest.ends, rest.radii, width)
        return points[bare[:: max(1, len(bare) // MOST_POINTS)]]

    def _data_to_model(self, places: Array | Singles, bare: Array) -> Array:
        """Returns the misfit (N,) of the unexplained points to the limb's surface (P, 3, N)."""
        centres, radii, points = (
            np.ascontiguousarray(one, dtype=np.float32) for one in (places, self.axes.radii, bare)
        )
        return mean_gaps(centres, radii, points, np.float32(self._cutoff))

    def _model_to_data(self, places: Array, points: Array, sight: Sight | None) -> Array:
        """Returns the misfit (N,) of the limb's surface (N, P, 3) to the points."""
        spheres = loop_input(places).reshape(-1, 3)
        # Beyond the cutoff from the surface, all distances count alike.
        distances = nearest_distances(spheres, points, 1.5 * self._cutoff)
        gaps = (distances.reshape(places.shape[:2]) - self.axes.radii).clip(0.0, self._cutoff)
        if sight is not None:
            gaps *= sight.observable(spheres).reshape(gaps.shape)
        return np.asarray(gaps.mean(axis=1) / self._cutoff)

    @cached_property
    def _length(self) -> float:
        """Largest distance of a point on the limb's axis from the first one [m]."""
        return float(np.linalg.norm(self.places - self.places[:1], axis=1).max())

    @cached_property
    def _cutoff(self) -> float:
        """Upper bound of a distance, the limb's width [m]."""
        return 2.0 * float(self.axes.radii.max())
