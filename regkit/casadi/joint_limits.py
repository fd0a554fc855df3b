"""Joint limits as smooth CasADi constraints.

For the rotation q of a ball joint relative to the centre of its cone, q = swing * twist:

- The deviation of the twist from the centre of its interval, an angle in (-pi, pi), is bounded by
  half the interval. The row is the angle itself, so its gradient never vanishes; its discontinuity
  is opposite to the interval.
- The swing (s_1, s_2) with the half angles a_1, a_2 has the row
  ``max(a) / 2 ((s_1 / a_1)^2 + (s_2 / a_2)^2 - 1) <= 0``, which is smooth at the identity, too.
  Outside the cone it is at least as large as the violation in radians.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import Any

import numpy as np

from regkit.casadi import rotations
from regkit.casadi.configuration import length, split
from regkit.casadi.constraint_rows import ConstraintRows, Row, accumulated
from regkit.geometry.rotation import conjugate, cross
from regkit.skeleton import Skeleton
from regkit.system.arrays import Array
from regkit.system.optional import load_library

NOWHERE = 1e-30
"""Added to squares that vanish for a swing by pi, where the twist is undefined."""


@lru_cache(maxsize=16)
def ball_limits(skeleton: Skeleton) -> ConstraintRows:
    """Returns the constraints of all limited ball joints: swing, then twist, joint by joint."""
    numbers = load_library("casadi").SX.sym("configuration", length(skeleton))
    return accumulated("ball_limits", numbers, list(_ball_rows(skeleton, numbers)))


@lru_cache(maxsize=16)
def joint_limits(skeleton: Skeleton) -> ConstraintRows:
    """Returns all limits of a skeleton: ball joints, then hinges, then couplings."""
    numbers = load_library("casadi").SX.sym("configuration", length(skeleton))
    rows = [*_ball_rows(skeleton, numbers), *_hinge_rows(skeleton, numbers)]
    return accumulated("joint_limits", numbers, rows)


def _ball_rows(skeleton: Skeleton, numbers: Any) -> Iterator[Row]:
    limits = skeleton.limits
    names = _names(skeleton, skeleton.ball_dofs, 3)
    for index, ball in enumerate(split(skeleton, numbers).balls):
        centre = conjugate(limits.centre[index])
        relative = rotations.product(load_library("casadi").DM(centre), rotations.normalized(ball))
        axis, half_angles = limits.twist_axis[index], limits.swing[index]
        if np.isfinite(half_angles).all():
            swing = _swing(relative, axis, limits.swing_axis[index])
            stretch = (swing[0] / half_angles[0]) ** 2 + (swing[1] / half_angles[1]) ** 2
            row = 0.5 * float(half_angles.max()) * (stretch - 1.0)
            yield Row(f"{names[index]}.swing", row, -np.inf, 0.0)
        low, high = limits.twist[index]
        half = 0.5 * (high - low)
        if half < np.pi:
            twist = _twist_from(relative, axis, 0.5 * (low + high))
            yield Row(f"{names[index]}.twist", twist, -half, half)


def _hinge_rows(skeleton: Skeleton, numbers: Any) -> Iterator[Row]:
    hinges = split(skeleton, numbers).hinges
    names = _names(skeleton, skeleton.hinge_dofs, 1)
    # The limits of a leader and the coupling imply the limits of a follower.
    for index in skeleton.limits.couplings.independent.tolist():
        low, high = skeleton.limits.hinge[index]
        if np.isfinite([low, high]).any():
            yield Row(names[index], hinges[index], float(low), float(high))
    couplings = skeleton.limits.couplings
    for follower, leader, ratio, offset in zip(
        couplings.followers, couplings.leaders, couplings.ratios, couplings.offsets, strict=True
    ):
        residual = hinges[int(follower)] - ratio * hinges[int(leader)] - offset
        yield Row(f"{names[follower]}.coupling", residual, 0.0, 0.0)


def _names(skeleton: Skeleton, dofs: slice, each: int) -> list[str]:
    """Returns the segment of each joint in a range of degrees of freedom."""
    owners = {int(one): name for name, own in skeleton.joint_dofs.items() for one in own}
    return [owners[first] for first in range(dofs.start, dofs.stop, each)]


def _twist_from(quaternion: Any, axis: Array, middle: float) -> Any:
    """Returns the deviation of the twist from ``middle``, in (-pi, pi) [rad]."""
    ca = load_library("casadi")
    along, scalar = ca.dot(quaternion[:3], axis), quaternion[3]
    # Sine and cosine of half the deviation, up to a common factor.
    sine = np.cos(0.5 * middle) * along - np.sin(0.5 * middle) * scalar
    cosine = np.cos(0.5 * middle) * scalar + np.sin(0.5 * middle) * along
    # A quaternion and its negative are the same rotation.
    sign = ca.if_else(cosine < 0.0, -1.0, 1.0)
    return 2.0 * ca.atan2(sign * sine, sign * cosine + np.sqrt(NOWHERE))


def _swing(quaternion: Any, axis: Array, first_axis: Array) -> Any:
    """Returns the two swing angles (2,) [rad]."""
    ca = load_library("casadi")
    along, scalar = ca.dot(quaternion[:3], axis), quaternion[3]
    # The cosine of half the swing; divided by it, these are sine and cosine of half the twist.
    level = ca.sqrt(along**2 + scalar**2 + NOWHERE)
    sine, cosine = along / level, scalar / level
    one = ca.dot(quaternion[:3], first_axis)
    two = ca.dot(quaternion[:3], cross(axis, first_axis))
    # The twist also rotated the swing axis; undo that.
    swing = ca.vertcat(cosine * one - sine * two, sine * one + cosine * two)
    square = ca.dot(swing, swing)
    small = square < rotations.SMALL
    size = ca.sqrt(ca.if_else(small, 1.0, square))
    series = 2.0 + square * (1.0 / 3.0 + square * (3.0 / 20.0 + square * 5.0 / 56.0))
    return ca.if_else(small, series, 2.0 * ca.atan2(size, level) / size) * swing
