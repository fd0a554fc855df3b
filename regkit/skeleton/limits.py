"""Joint limits: intervals and couplings of hinges, a swing cone and a twist interval of balls."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from regkit.geometry.rotation import (
    conjugate,
    cross,
    from_vector,
    product,
    right_jacobian,
    swing_twist,
    to_matrix,
)
from regkit.skeleton.compiled_steps import within_limits
from regkit.skeleton.couplings import Couplings
from regkit.skeleton.pose import Pose
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Limits:
    """All limits of a skeleton; what has none is bounded by infinity.

    Attributes:
        hinge: Lower and upper angle, (n_hinge, 2) [rad]; within those of a leader its followers
            keep theirs.
        couplings: Hinges that follow others.
        centre: Middle of each ball's cone as a unit quaternion, (n_ball, 4).
        twist_axis: Unit vectors in the segments' frames, (n_ball, 3).
        swing_axis: Axes of the first swing angle, (n_ball, 3).
        swing: Half angles of the cone, (n_ball, 2) [rad].
        twist: Lower and upper twist, (n_ball, 2) [rad].
    """

    hinge: Array
    couplings: Couplings
    centre: Array
    twist_axis: Array
    swing_axis: Array
    swing: Array
    twist: Array

    def violation(self, pose: Pose) -> Array:
        """How far beyond its limits each joint is, (n_ball + n_hinge,) [rad]; zero inside.

        A ball's is the larger of its twist's and its swing's; the latter is measured along the ray
        from the middle of the cone through the swing. A hinge that follows another may violate its
        coupling too, and the larger counts.
        """
        swing, twist = self._swing_twist(pose)
        stretch = self._stretch(swing)
        angle = np.linalg.norm(swing, axis=1)
        outside = angle * (1.0 - 1.0 / np.maximum(stretch, 1.0))
        balls = np.maximum(outside, _beyond(twist, self.twist))
        hinges = _beyond(pose.hinges, self.hinge)
        followers = self.couplings.followers
        misfit = np.abs(self.couplings.misfit(pose.hinges))
        hinges[followers] = np.maximum(hinges[followers], misfit)
        return np.concatenate([balls, hinges])

    def slopes(self, pose: Pose) -> tuple[Array, Array, Array]:
        """How far beyond its limits each twist, swing and hinge is, and the derivative of that.

        Returns:
            The violations (2 n_ball + n_hinge,) [rad] of all twists, all swings and all hinges; the
            derivatives (2, n_ball, 3) of the twists' and swings' to a rotation vector in the frame
            that the ball turns; and those of the hinges', (n_hinge,).
        """
        relative = product(self._from_centre, pose.balls)
        swing, twist = swing_twist(relative, self.twist_axis)
        beyond, sign = _signed_beyond(twist, self.twist)
        # dq = q (w, 0) / 2 moves the twist angle 2 atan2(q.a, q_w).
        along = (relative[:, :3] * self.twist_axis).sum(axis=1, keepdims=True)
        scalar = relative[:, 3:]
        to_twist = scalar * self._turned(relative) + along * relative[:, :3]
        to_twist /= np.maximum(along**2 + scalar**2, 1e-12)
        # exp(swing) = q exp(-twist a), so a turn w of q turns the swing by R_twist w - a dtwist.
        turned = to_matrix(from_vector(twist[:, None] * self.twist_axis))
        turned = turned - self.twist_axis[:, :, None] * to_twist[:, None, :]
        to_swing = np.linalg.inv(right_jacobian(swing)) @ turned
        stretch = self._stretch(swing)
        outside = stretch > 1.0
        safe = np.where(outside, stretch, 1.0)
        angle = np.linalg.norm(swing, axis=1)
        # v = |s| - |s| / g(s), with the stretch g.
        rate = swing / np.maximum(angle, 1e-12)[:, None] * (1.0 - 1.0 / safe)[:, None]
        rate += (angle / safe**2)[:, None] * self._stretch_rate(swing, safe)
        swings = np.where(outside[:, None], (rate[:, None, :] @ to_swing)[:, 0], 0.0)
        hinges, hinge_sign = _signed_beyond(pose.hinges, self.hinge)
        violations = np.concatenate([beyond, angle * (1.0 - 1.0 / safe), hinges])
        return violations, np.stack([sign[:, None] * to_twist, swings]), hinge_sign

    def hinged(self, pose: Pose) -> Pose:
        """The pose with its hinges within their limits, followers following; balls as they are."""
        hinges = self.couplings.coupled(pose.hinges.clip(self.hinge[:, 0], self.hinge[:, 1]))
        return Pose(pose.root, pose.balls, hinges)

    def projected(self, pose: Pose) -> Pose:
        """The pose itself if it keeps the limits; else hinges, swings and twists brought to them.

        A swing is shortened towards the middle of its cone; a hinge follows its leader.
        """
        balls, turned = within_limits(
            pose.balls, self.centre, self.twist_axis, self._cone, self.twist
        )
        hinges = self.hinged(pose).hinges
        if not turned and (hinges == pose.hinges).all():
            return pose
        return Pose(pose.root, balls, hinges)

    def sampled(self, random: np.random.Generator, count: int) -> tuple[Array, Array]:
        """Joint angles evenly spread over their limits, or all round where there is none.

        Returns:
            Unit quaternions (count, n_ball, 4) and hinge angles (count, n_hinge) [rad].
        """
        shape = (count, len(self.centre))
        radius = np.sqrt(random.uniform(size=shape))
        phase = random.uniform(-np.pi, np.pi, size=shape)
        half = np.minimum(self.swing, np.pi)
        second = cross(self.twist_axis, self.swing_axis)
        swing = (radius * np.cos(phase) * half[:, 0])[..., None] * self.swing_axis
        swing += (radius * np.sin(phase) * half[:, 1])[..., None] * second
        twist = _between(np.clip(self.twist, -np.pi, np.pi), random, count)
        turned = from_vector(twist[..., None] * self.twist_axis)
        hinges = _between(np.clip(self.hinge, -np.pi, np.pi), random, count)
        balls = product(self.centre, product(from_vector(swing), turned))
        return balls, self.couplings.coupled(hinges)

    def _swing_twist(self, pose: Pose) -> tuple[Array, Array]:
        """Swing vectors (n_ball, 3) and twist angles (n_ball,) relative to the cones' middles."""
        return swing_twist(product(self._from_centre, pose.balls), self.twist_axis)

    def _turned(self, relative: Array) -> Array:
        """The derivative of q.a to w in dq = q (w, 0) / 2, but for the half: q_w a - q x a."""
        return np.asarray(
            relative[:, 3:] * self.twist_axis - cross(relative[:, :3], self.twist_axis)
        )

    def _stretch_rate(self, swing: Array, stretch: Array) -> Array:
        """The derivative (n_ball, 3) of the stretch to the swing."""
        second = cross(self.twist_axis, self.swing_axis)
        first_part = (swing * self.swing_axis).sum(axis=1) / self.swing[:, 0] ** 2 / stretch
        second_part = (swing * second).sum(axis=1) / self.swing[:, 1] ** 2 / stretch
        return np.asarray(first_part[:, None] * self.swing_axis + second_part[:, None] * second)

    def _stretch(self, swing: Array) -> Array:
        """How long a swing is against the cone in its direction, (n_ball,); above 1 outside."""
        parts = (self._cone @ swing[:, :, None])[:, :, 0]
        return np.asarray(np.hypot(parts[:, 0], parts[:, 1]))

    @cached_property
    def _cone(self) -> Array:
        """The two swing axes over the cone's half angles, (n_ball, 2, 3) [1/rad]."""
        axes = np.stack([self.swing_axis, cross(self.twist_axis, self.swing_axis)], axis=1)
        return np.asarray(axes / self.swing[:, :, None])

    @cached_property
    def _from_centre(self) -> Array:
        return conjugate(self.centre)


def _beyond(angles: Array, interval: Array) -> Array:
    return np.maximum(np.maximum(interval[:, 0] - angles, angles - interval[:, 1]), 0.0)


def _between(intervals: Array, random: np.random.Generator, count: int) -> Array:
    """Evenly spread angles (count, M) in intervals (M, 2)."""
    share = random.uniform(size=(count, len(intervals)))
    return np.asarray(intervals[:, 0] + share * (intervals[:, 1] - intervals[:, 0]))


def _signed_beyond(angles: Array, interval: Array) -> tuple[Array, Array]:
    """How far angles are beyond an interval, and the derivative of that: -1, 0 or 1."""
    sign = (angles > interval[:, 1]).astype(float) - (angles < interval[:, 0])
    return _beyond(angles, interval), sign
