"""The spread of poses over the joint limits, which is what is known without data."""

from __future__ import annotations

import numpy as np

from regkit.geometry.rotation import cross
from regkit.skeleton.limits import Limits
from regkit.system.arrays import Array

FAR = 10.0
"""Standard deviation of a free segment's position [m]: anywhere in a room."""

NARROW = np.radians(0.1)
"""Least standard deviation of a joint [rad or m], for limits that leave no room."""


def spread_variances(limits: Limits, *, free: bool) -> Array:
    """Returns the covariance (n, n) of poses that are spread evenly over the limits.

    A uniform angle in an interval has the variance (b - a)^2 / 12; a swing in an ellipse that of
    the half angle, squared, / 4, along each axis. An unlimited rotation is anywhere in a turn.

    Args:
        limits: The limits.
        free: Whether the root has a free joint.
    """
    turn = (2.0 * np.pi) ** 2 / 12.0
    balls, hinges = len(limits.centre), len(limits.hinge)
    first = 6 if free else 0
    variances = np.zeros((first + 3 * balls + hinges, first + 3 * balls + hinges))
    if free:
        variances[range(6), range(6)] = [FAR**2] * 3 + [turn] * 3
    swings = np.maximum(np.minimum(limits.swing, np.pi) ** 2 / 4.0, NARROW**2)
    twists = _even(limits.twist)
    second = cross(limits.twist_axis, limits.swing_axis)
    axes = np.stack([limits.swing_axis, second, limits.twist_axis], axis=1)
    for ball in range(balls):
        at = slice(first + 3 * ball, first + 3 * ball + 3)
        each = np.array([*swings[ball], twists[ball]])
        variances[at, at] = np.einsum("ki,k,kj->ij", axes[ball], each, axes[ball])
    own = np.arange(first + 3 * balls, len(variances))
    widest = np.where(limits.prismatic, FAR * np.sqrt(12.0), 2.0 * np.pi)
    variances[own, own] = _even(limits.hinge, widest)
    return variances


def _even(intervals: Array, widest: Array | float = 2.0 * np.pi) -> Array:
    """Returns the variances (M,) of uniform numbers in intervals (M, 2), by default of angles."""
    width = np.minimum(intervals[:, 1] - intervals[:, 0], widest)
    return np.asarray(np.maximum(width**2 / 12.0, NARROW**2))
