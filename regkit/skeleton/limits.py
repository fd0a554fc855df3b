"""Joint limits: intervals and couplings for hinges, swing cones and twist intervals for balls."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

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
from regkit.system.brief import Brief


@dataclass(frozen=True)
class Limits(Brief):
    """All joint limits of a skeleton; an unlimited joint has infinite bounds.

    Attributes:
        hinge: Lower and upper angle [rad] or displacement [m], (n_hinge, 2); a leader's limits
            include those that its followers imply.
        prismatic: Whether each hinge is a prismatic joint, (n_hinge,).
        couplings: Hinges that follow others.
        centre: Centre of each ball's swing cone as a unit quaternion, (n_ball, 4).
        twist_axis: Unit vectors in the segment frames, (n_ball, 3).
        swing_axis: Axes of the first swing angle, (n_ball, 3).
        swing: Half angles of the swing cone, (n_ball, 2) [rad].
        twist: Lower and upper twist, (n_ball, 2) [rad].
    """

    hinge: Array
    prismatic: NDArray[np.bool_]
    couplings: Couplings
    centre: Array
    twist_axis: Array
    swing_axis: Array
    swing: Array
    twist: Array

    def violation(self, pose: Pose) -> Array:
        """Returns the limit violation of each joint, (n_ball + n_hinge,) [rad or m]; zero inside.

        The violation of a ball joint is the larger of its twist and swing violations; the latter is
        measured along the ray from the centre of the cone through the swing. The violation of a
        coupled hinge is the larger of its interval violation and its coupling residual.
        """
        swing, twist = self._swing_twist(pose)
        stretch = self._stretch(swing)
        angle = np.linalg.norm(swing, axis=1)
        outside = angle * (1.0 - 1.0 / np.maximum(stretch, 1.0))
        balls = np.maximum(outside, _beyond(twist, self.twist))
        hinges = _beyond(pose.hinges, self.hinge)
        followers = self.couplings.followers
        residuals = np.abs(self.couplings.residuals(pose.hinges))
        hinges[followers] = np.maximum(hinges[followers], residuals)
        return np.concatenate([balls, hinges])

    def linearized(self, pose: Pose) -> tuple[Array, Array, Array]:
        """Returns the violations of all twists, swings and hinges, and their derivatives.

        Returns:
            The violations of all twists, then all swings, then all hinges, (2 n_ball + n_hinge,)
            [rad]; the derivatives of twist and swing violations to a rotation vector in the frame
            of the ball's segment, (2, n_ball, 3); the derivatives of hinge violations, (n_hinge,).
        """
        relative = product(self._from_centre, pose.balls)
        swing, twist = swing_twist(relative, self.twist_axis)
        beyond, sign = _signed_beyond(twist, self.twist)
        # dq = q (w, 0) / 2 moves the twist angle 2 atan2(q.a, q_w).
        along = (relative[:, :3] * self.twist_axis).sum(axis=1, keepdims=True)
        scalar = relative[:, 3:]
        to_twist = scalar * self._twist_rate(relative) + along * relative[:, :3]
        to_twist /= np.maximum(along**2 + scalar**2, 1e-12)
        # exp(swing) = q exp(-twist a): rotating q by w rotates the swing by R_twist w - a dtwist.
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
        """Returns the pose with hinges clipped to limits and couplings; balls are unchanged."""
        hinges = self.couplings.coupled(pose.hinges.clip(self.hinge[:, 0], self.hinge[:, 1]))
        return Pose(pose.root, pose.balls, hinges)

    def projected(self, pose: Pose) -> Pose:
        """Returns the pose projected onto the limits; the same object if it satisfies them.

        Hinges and twists are clipped, swings are shortened towards the centre of their cone, and
        followers are set from their leaders.
        """
        balls, turned = within_limits(
            pose.balls, self.centre, self.twist_axis, self.cone, self.twist
        )
        hinges = self.hinged(pose).hinges
        if not turned and (hinges == pose.hinges).all():
            return pose
        return Pose(pose.root, balls, hinges)

    def sampled(self, random: np.random.Generator, count: int) -> tuple[Array, Array]:
        """Samples joints uniformly within the limits; unlimited angles within a full turn.

        Unlimited displacements, which are those of a free segment, stay zero.

        Args:
            random: Random generator.
            count: Number of samples.

        Returns:
            Unit quaternions (count, n_ball, 4) and the hinges' angles [rad] or displacements [m],
            (count, n_hinge).
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
        turns = np.clip(self.hinge, -np.pi, np.pi)
        travels = np.where(np.isfinite(self.hinge), self.hinge, 0.0)
        hinges = _between(np.where(self.prismatic[:, None], travels, turns), random, count)
        balls = product(self.centre, product(from_vector(swing), turned))
        return balls, self.couplings.coupled(hinges)

    def _swing_twist(self, pose: Pose) -> tuple[Array, Array]:
        """Returns swing vectors (n_ball, 3) and twists (n_ball,) relative to the cone centres."""
        return swing_twist(product(self._from_centre, pose.balls), self.twist_axis)

    def _twist_rate(self, relative: Array) -> Array:
        """Returns q_w a - q x a, twice the derivative of q.a to w in dq = q (w, 0) / 2."""
        return np.asarray(
            relative[:, 3:] * self.twist_axis - cross(relative[:, :3], self.twist_axis)
        )

    def _stretch_rate(self, swing: Array, stretch: Array) -> Array:
        """Returns the derivative (n_ball, 3) of the stretch to the swing."""
        second = cross(self.twist_axis, self.swing_axis)
        first_part = (swing * self.swing_axis).sum(axis=1) / self.swing[:, 0] ** 2 / stretch
        second_part = (swing * second).sum(axis=1) / self.swing[:, 1] ** 2 / stretch
        return np.asarray(first_part[:, None] * self.swing_axis + second_part[:, None] * second)

    def _stretch(self, swing: Array) -> Array:
        """Returns the swing's length relative to the cone in its direction; above 1 outside."""
        parts = (self.cone @ swing[:, :, None])[:, :, 0]
        return np.asarray(np.hypot(parts[:, 0], parts[:, 1]))

    @cached_property
    def cone(self) -> Array:
        """The two swing axes divided by the half angles of the cone, (n_ball, 2, 3) [1/rad]."""
        axes = np.stack([self.swing_axis, cross(self.twist_axis, self.swing_axis)], axis=1)
        return np.asarray(axes / self.swing[:, :, None])

    @cached_property
    def _from_centre(self) -> Array:
        return conjugate(self.centre)


def _beyond(angles: Array, interval: Array) -> Array:
    return np.maximum(np.maximum(interval[:, 0] - angles, angles - interval[:, 1]), 0.0)


def _between(intervals: Array, random: np.random.Generator, count: int) -> Array:
    """Returns uniform samples (count, M) of intervals (M, 2)."""
    share = random.uniform(size=(count, len(intervals)))
    return np.asarray(intervals[:, 0] + share * (intervals[:, 1] - intervals[:, 0]))


def _signed_beyond(angles: Array, interval: Array) -> tuple[Array, Array]:
    """Returns the violation of an interval and its derivative: -1, 0 or 1."""
    sign = (angles > interval[:, 1]).astype(float) - (angles < interval[:, 0])
    return _beyond(angles, interval), sign
