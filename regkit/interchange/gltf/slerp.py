"""Spherical linear interpolation of rotations."""

from __future__ import annotations

import numpy as np

from regkit.geometry.rotation import normalized
from regkit.system.arrays import Array


def slerp(start: Array, end: Array, share: float) -> Array:
    """Returns the unit quaternion (..., 4) at the fraction ``share`` of the shorter arc.

    Args:
        start: Unit quaternions, (..., 4).
        end: Unit quaternions, (..., 4).
        share: Fraction of the arc, from 0 to 1.
    """
    cosine = (start * end).sum(axis=-1, keepdims=True)
    half = np.arccos(np.clip(np.abs(cosine), 0.0, 1.0))
    # For small angles linear interpolation is exact, and avoids a division by zero.
    small = half < 1e-4
    sine = np.where(small, 1.0, np.sin(half))
    first = np.where(small, 1.0 - share, np.sin((1.0 - share) * half) / sine)
    second = np.where(small, share, np.sin(share * half) / sine)
    return normalized(first * start + np.copysign(second, cosine) * end)
