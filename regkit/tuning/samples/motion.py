"""Random motion of a body within its joint limits, as a camera would see it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from regkit.body import Body
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import (
    conjugate,
    from_matrix,
    from_vector,
    product,
    to_matrix,
    to_vector,
)
from regkit.search.exemplars.poses import sampled_poses
from regkit.search.limbs import limbs_of
from regkit.skeleton import Pose
from regkit.system.arrays import Array, Indices
from regkit.system.errors import ConfigError
from regkit.tuning.samples.overlap import SelfOverlap
from regkit.tuning.samples.pace import Pace

TRIES = 300
"""Number of motions that are drawn until one does not intersect itself."""

CHOICE = 3
"""Number of poses that are drawn for each that a motion goes through."""

AGREEMENT = 0.2
"""Standard deviation of a limb's share of two poses about that of the whole body."""

DRIFT = np.array([0.15, 0.04, 0.15])
"""Standard deviation of the root's position, in sizes of the body, along x, y and z."""

LEAN, TURN = np.radians(8.0), np.radians(25.0)
"""Standard deviation of the root's rotation about the horizontal axes of an upright body, and about
its vertical one; other bodies turn about all axes alike [rad]."""


@dataclass(frozen=True)
class Movement:
    """Random motion of a body about its origin.

    Each limb, the trunk and the root go smoothly from one random pose to the next, at a pace of
    their own or all together; some are still. Poses mix two stances or shaken stances, with limbs
    anywhere within their limits. No pose exceeds a limit or intersects itself.

    Attributes:
        body: The body.
        fastest: Greatest displacement of any part from one frame to the next, in sizes of the body.
    """

    body: Body
    fastest: float = 0.07

    def sampled(self, random: np.random.Generator, frames: int) -> list[Pose]:
        """Returns the poses of successive frames.

        The root is near the identity: the body faces z, and y is up.

        Args:
            random: Source of the motion.
            frames: Number of frames.

        Raises:
            ConfigError: If every motion intersects itself.
        """
        for _ in range(TRIES):
            poses = self._drawn(random, frames)
            if self._overlap.allowed(self._placed(poses)).all():
                return poses
        raise ConfigError(
            f"the template '{self.body.name}' intersects itself in each of {TRIES} motions within "
            "its joint limits; narrow the limits, or make its capsules thinner where segments "
            "that no joint connects overlap"
        )

    def _drawn(self, random: np.random.Generator, frames: int) -> list[Pose]:
        """Returns a motion that may intersect itself, slowed down to the allowed speed."""
        pace = Pace.sampled(random, self._parts, frames)
        keys = self._keys(random, pace.keys)
        times, slower = np.arange(frames, dtype=float), 1.0
        most = self.fastest * self.body.size
        while True:
            poses = self._posed(keys, *pace.at(slower * times))
            speed = self._speed(poses)
            if speed <= most:
                return poses
            slower *= 0.98 * most / speed

    def _keys(self, random: np.random.Generator, count: int) -> Pose:
        """Returns the poses (K) that the parts go through.

        Poses that do not intersect themselves are preferred, so that few motions are in vain.
        """
        drawn = self._mixed(random, CHOICE * count)
        posed = self.body.place(Pose(np.eye(4), drawn.balls, drawn.hinges))
        kept = np.argsort(~self._overlap.allowed(posed.transforms), kind="stable")[:count]
        return Pose(self._roots(random, count), drawn.balls[kept], drawn.hinges[kept])

    def _mixed(self, random: np.random.Generator, count: int) -> Pose:
        """Returns poses (K) of the joints, each a mixture of two."""
        balls, hinges = sampled_poses(self.body, random, 2 * count)
        whole = random.beta(0.5, 0.5, size=(count, 1))
        share = whole + AGREEMENT * random.normal(size=(count, self._parts))
        share = np.clip(share, 0.0, 1.0)
        mixed = _between(balls[:count], balls[count:], share[:, self._of_balls, None])
        of_hinges = share[:, self._of_hinges]
        angles = hinges[:count] + of_hinges * (hinges[count:] - hinges[:count])
        return Pose(np.eye(4), mixed, angles)

    def _roots(self, random: np.random.Generator, count: int) -> Array:
        """Returns T_body_root (K, 4, 4)."""
        if not self.body.skeleton.free:
            return np.tile(np.eye(4), (count, 1, 1))
        spread = np.array([LEAN, TURN, LEAN]) if self.body.upright else np.full(3, TURN)
        turns = to_matrix(from_vector(spread * random.normal(size=(count, 3))))
        return rigid(turns, self.body.size * DRIFT * random.normal(size=(count, 3)))

    def _posed(self, keys: Pose, left: Indices, share: Array) -> list[Pose]:
        """Returns the poses between keys, for the key and share of each part, (T, P)."""
        limits, following = self.body.skeleton.limits, left + 1
        balls, hinges = np.arange(keys.balls.shape[1]), np.arange(keys.hinges.shape[1])
        of_balls, of_hinges = left[:, self._of_balls], left[:, self._of_hinges]
        turned = _between(
            keys.balls[of_balls, balls],
            keys.balls[of_balls + 1, balls],
            share[:, self._of_balls, None],
        )
        start, end = keys.hinges[of_hinges, hinges], keys.hinges[of_hinges + 1, hinges]
        angles = start + share[:, self._of_hinges] * (end - start)
        first, second = keys.root[left[:, -1]], keys.root[following[:, -1]]
        roots = _moved(first, second, share[:, -1])
        return [
            limits.projected(Pose(root, turned[frame], angles[frame]))
            for frame, root in enumerate(roots)
        ]

    def _placed(self, poses: list[Pose]) -> Array:
        """Returns T_root_segment (T, S, 4, 4)."""
        balls = np.array([pose.balls for pose in poses])
        hinges = np.array([pose.hinges for pose in poses])
        return self.body.place(Pose(np.eye(4), balls, hinges)).transforms

    def _speed(self, poses: list[Pose]) -> float:
        """Returns the greatest displacement of an end of a capsule between two frames [m]."""
        if len(poses) < 2:
            return 0.0
        roots = np.array([pose.root for pose in poses])
        carriers = (roots[:, None] @ self._placed(poses))[:, self.body.capsules.segments]
        ends = self.body.capsules.ends @ np.swapaxes(carriers[..., :3, :3], -1, -2)
        ends += carriers[..., None, :3, 3]
        return float(np.linalg.norm(np.diff(ends, axis=0), axis=-1).max())

    @cached_property
    def _overlap(self) -> SelfOverlap:
        return SelfOverlap.of(self.body)

    @cached_property
    def _limbs(self) -> list[tuple[Indices, Indices]]:
        return [(limb.balls, limb.hinges) for limb in limbs_of(self.body)]

    @property
    def _parts(self) -> int:
        """The number of parts: the limbs, the trunk and the root, in this order."""
        return len(self._limbs) + 2

    @cached_property
    def _of_balls(self) -> Indices:
        """The part of each ball joint."""
        parts = np.full(len(self.body.skeleton.ball_links), len(self._limbs))
        for part, (balls, _) in enumerate(self._limbs):
            parts[balls] = part
        return parts

    @cached_property
    def _of_hinges(self) -> Indices:
        """The part of each hinge."""
        parts = np.full(len(self.body.skeleton.hinge_links), len(self._limbs))
        for part, (_, hinges) in enumerate(self._limbs):
            parts[hinges] = part
        return parts


def _between(start: Array, end: Array, share: Array) -> Array:
    """Returns quaternions (..., 4) at shares (..., 1) of the shorter arcs."""
    return product(start, from_vector(share * to_vector(product(conjugate(start), end))))


def _moved(start: Array, end: Array, share: Array) -> Array:
    """Returns transforms (T, 4, 4) at shares (T,) of the ways: positions straight, turns short."""
    first, second = from_matrix(start[:, :3, :3]), from_matrix(end[:, :3, :3])
    turns = to_matrix(_between(first, second, share[:, None]))
    ways = share[:, None] * (end[:, :3, 3] - start[:, :3, 3])
    return rigid(turns, start[:, :3, 3] + ways)
