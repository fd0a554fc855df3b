"""Repair of recorded joint rotations: discontinuities, open loops, jitter."""

from __future__ import annotations

import numpy as np

from regkit.geometry.rotation import conjugate, from_vector, product, to_vector
from regkit.system.arrays import Array

_CLOSING = 1.0 / 3.0
"""Fraction at the end of a looping clip that is adjusted to match its beginning."""

_BRIDGE = 0.35
"""Time on both sides of a discontinuity within which a clip is adjusted [s]."""


def interpolated(start: Array, end: Array, share: float | Array) -> Array:
    """Returns the spherical linear interpolation (..., 4) of unit quaternions (slerp).

    Source: Shoemake, Animating Rotation with Quaternion Curves, SIGGRAPH 1985.
    """
    return product(start, from_vector(share * to_vector(product(conjugate(start), end))))


def bridged(times: Array, joints: Array, row: int) -> Array:
    """Returns the rotations (F, J, 4) without the discontinuity after ``row``.

    Both sides are adjusted so that this step becomes the mean of the adjacent ones.

    Args:
        times: Time of each row, (F,) [s].
        joints: Unit quaternions, (F, J, 4).
        row: The last row before the discontinuity.
    """
    steps = to_vector(product(conjugate(joints[:-1]), joints[1:]))
    jump = steps[row] - (steps[row - 1] + steps[row + 1]) / 2
    middle = (times[row] + times[row + 1]) / 2
    share = smooth_step(1.0 - np.abs(times - middle) / _BRIDGE) / 2
    signed = np.where(np.arange(len(times)) <= row, share, -share)
    return product(joints, from_vector(signed[:, None, None] * jump))


def closing(times: Array) -> Array:
    """Returns the fraction (F,) of the gap of an open loop that is closed at ``times`` (F,) [s]."""
    return smooth_step((times / times[-1] - 1.0) / _CLOSING + 1.0)


def closed(times: Array, joints: Array) -> Array:
    """Returns rotations (F, J, 4) adjusted over the end of the clip to match its beginning."""
    gap = to_vector(product(conjugate(joints[-1]), joints[0]))
    return product(joints, from_vector(closing(times)[:, None, None] * gap))


def smoothed(joints: Array) -> Array:
    """Returns rotations (F, J, 4) averaged with the mean of their neighbours; the ends are kept."""
    before = to_vector(product(conjugate(joints[1:-1]), joints[:-2]))
    after = to_vector(product(conjugate(joints[1:-1]), joints[2:]))
    inner = product(joints[1:-1], from_vector((before + after) / 4.0))
    return np.concatenate([joints[:1], inner, joints[-1:]])


def smooth_step(phase: Array) -> Array:
    """Returns a smooth step from 0 to 1 of the phase (...), with continuous derivative."""
    within = np.clip(phase, 0.0, 1.0)
    return np.asarray(within * within * (3.0 - 2.0 * within))
