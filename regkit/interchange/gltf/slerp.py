"""Rotations between two others."""

from __future__ import annotations

import numpy as np

from regkit.geometry.rotation import normalized
from regkit.system.arrays import Array


def slerp(start: Array, end: Array, share: float) -> Array:
    """A unit quaternion (..., 4) on the shorter arc between two, ``share`` of the way along it."""
    cosine = (start * end).sum(axis=-1, keepdims=True)
    half = np.arccos(np.clip(np.abs(cosine), 0.0, 1.0))
    # At small angles the chord is the arc; it also spares a division by zero.
    small = half < 1e-4
    sine = np.where(small, 1.0, np.sin(half))
    first = np.where(small, 1.0 - share, np.sin((1.0 - share) * half) / sine)
    second = np.where(small, share, np.sin(share * half) / sine)
    return normalized(first * start + np.copysign(second, cosine) * end)
