"""Joint limits: intervals for hinges, a swing cone and a twist interval for ball joints."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.arrays import Array
from regkit.rotation import conjugate, product, swing_twist
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
        hinges = _beyond(pose.hinges, self.hinge)
        relative = product(conjugate(self.centre), pose.balls)
        swing, twist = swing_twist(relative, self.twist_axis)
        first = (swing * self.swing_axis).sum(axis=-1)
        second = (swing * np.cross(self.twist_axis, self.swing_axis)).sum(axis=-1)
        stretch = np.hypot(first / self.swing[:, 0], second / self.swing[:, 1])
        angle = np.hypot(first, second)
        outside = np.where(stretch > 1.0, angle * (1.0 - 1.0 / np.maximum(stretch, 1.0)), 0.0)
        return np.concatenate([np.maximum(outside, _beyond(twist, self.twist)), hinges])


def _beyond(angles: Array, interval: Array) -> Array:
    return np.maximum(np.maximum(interval[:, 0] - angles, angles - interval[:, 1]), 0.0)
