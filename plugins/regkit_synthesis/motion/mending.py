"""Mends recorded joint rotations: jumps, ends that do not meet, jitter."""

from __future__ import annotations

import numpy as np

from regkit.geometry.rotation import conjugate, from_vector, product, to_vector
from regkit.system.arrays import Array

_CLOSING = 1.0 / 3.0
"""The last part of a looping clip that is bent so that its end meets its beginning."""

_BRIDGE = 0.35
"""How far to both sides of a jump a clip is bent to bridge it [s]."""


def interpolated(start: Array, end: Array, share: float | Array) -> Array:
    """Unit quaternions (..., 4) on the shortest way from ``start`` to ``end`` (slerp).

    Source: Shoemake, Animating Rotation with Quaternion Curves, SIGGRAPH 1985.
    """
    return product(start, from_vector(share * to_vector(product(conjugate(start), end))))


def bridged(times: Array, joints: Array, row: int) -> Array:
    """The rotations without the jump between ``row`` and the next.

    Both sides are bent towards each other, so that this step becomes the mean of its neighbours.

    Args:
        times: (F,) time of each row [s].
        joints: (F, J, 4) unit quaternions.
        row: The last one before the jump.
    """
    steps = to_vector(product(conjugate(joints[:-1]), joints[1:]))
    jump = steps[row] - (steps[row - 1] + steps[row + 1]) / 2
    middle = (times[row] + times[row + 1]) / 2
    share = smooth_step(1.0 - np.abs(times - middle) / _BRIDGE) / 2
    signed = np.where(np.arange(len(times)) <= row, share, -share)
    return product(joints, from_vector(signed[:, None, None] * jump))


def closing(times: Array) -> Array:
    """How much (F,) of the gap at the end of a clip is closed at ``times`` (F,): at last, all."""
    return smooth_step((times / times[-1] - 1.0) / _CLOSING + 1.0)


def closed(times: Array, joints: Array) -> Array:
    """Rotations (F, J, 4) bent smoothly over the last part of the clip, to end as they begin."""
    gap = to_vector(product(conjugate(joints[-1]), joints[0]))
    return product(joints, from_vector(closing(times)[:, None, None] * gap))


def smoothed(joints: Array) -> Array:
    """Rotations (F, J, 4) drawn halfway to the mean of those before and after; the ends stay."""
    before = to_vector(product(conjugate(joints[1:-1]), joints[:-2]))
    after = to_vector(product(conjugate(joints[1:-1]), joints[2:]))
    inner = product(joints[1:-1], from_vector((before + after) / 4.0))
    return np.concatenate([joints[:1], inner, joints[-1:]])


def smooth_step(phase: Array) -> Array:
    """From 0 to 1 as the phase (...) does, without a jump in its rate of change."""
    within = np.clip(phase, 0.0, 1.0)
    return np.asarray(within * within * (3.0 - 2.0 * within))
