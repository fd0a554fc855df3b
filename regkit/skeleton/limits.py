"""Joint limits: intervals for hinges, a swing cone and a twist interval for ball joints."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.arrays import Array
from regkit.rotation import conjugate, from_vector, product, swing_twist
from regkit.skeleton.pose import Pose


@dataclass(frozen=True)
class Limits:
    """All limits of a skeleton; what has none is bounded by infinity.

    Attributes:
        hinge: Lower and upper angle, (n_hinge, 2) [rad].
        centre: Middle of each ball's cone as a unit quaternion, (n_ball, 4).
        twist_axis: Unit vectors in the segments' frames, (n_ball, 3).
        swing_axis: Axes of the first swing angle, (n_ball, 3).
        swing: Half angles of the cone, (n_ball, 2) [rad].
        twist: Lower and upper twist, (n_ball, 2) [rad].
    """

    hinge: Array
    centre: Array
    twist_axis: Array
    swing_axis: Array
    swing: Array
    twist: Array

    def violation(self, pose: Pose) -> Array:
        """How far beyond its limits each joint is, (n_ball + n_hinge,) [rad]; zero inside.

        A ball's is the larger of its twist's and its swing's; the latter is measured along the ray
        from the middle of the cone through the swing.
        """
        swing, twist = self._swing_twist(pose)
        stretch = self._stretch(swing)
        angle = np.linalg.norm(swing, axis=1)
        outside = angle * (1.0 - 1.0 / np.maximum(stretch, 1.0))
        balls = np.maximum(outside, _beyond(twist, self.twist))
        return np.concatenate([balls, _beyond(pose.hinges, self.hinge)])

    def projected(self, pose: Pose) -> Pose:
        """The pose itself if it keeps the limits; else hinges, swings and twists brought to them.

        A swing is shortened towards the middle of its cone.
        """
        if not self.violation(pose).any():
            return pose
        swing, twist = self._swing_twist(pose)
        shortened = swing / np.maximum(self._stretch(swing), 1.0)[:, None]
        turned = np.clip(twist, self.twist[:, 0], self.twist[:, 1])[:, None] * self.twist_axis
        within = product(self.centre, product(from_vector(shortened), from_vector(turned)))
        hinges = np.clip(pose.hinges, self.hinge[:, 0], self.hinge[:, 1])
        return Pose(pose.root, within, hinges)

    def _swing_twist(self, pose: Pose) -> tuple[Array, Array]:
        """Swing vectors (n_ball, 3) and twist angles (n_ball,) relative to the cones' middles."""
        return swing_twist(product(conjugate(self.centre), pose.balls), self.twist_axis)

    def _stretch(self, swing: Array) -> Array:
        """How long a swing is against the cone in its direction, (n_ball,); above 1 outside."""
        first = (swing * self.swing_axis).sum(axis=-1)
        second = (swing * np.cross(self.twist_axis, self.swing_axis)).sum(axis=-1)
        return np.asarray(np.hypot(first / self.swing[:, 0], second / self.swing[:, 1]))


def _beyond(angles: Array, interval: Array) -> Array:
    return np.maximum(np.maximum(interval[:, 0] - angles, angles - interval[:, 1]), 0.0)
