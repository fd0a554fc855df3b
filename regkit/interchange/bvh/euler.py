"""Euler angles that are continuous over time."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array

LOCKED = 1e-6
"""Gimbal lock: if the cosine of the middle angle is smaller, the outer axes coincide."""


def continuous_zyx(rotations: Array) -> Array:
    """Returns angles (T, 3) [rad] with R = Rz(a) Ry(b) Rx(c), closest to those of the last frame.

    Each rotation has two triples of angles, up to full turns; the closest one is used, so that
    interpolation between frames does not spin. In gimbal lock the first angle is kept.

    Args:
        rotations: Rotation matrices, (T, 3, 3).
    """
    angles = np.zeros((len(rotations), 3))
    before = np.zeros(3)
    for index, matrix in enumerate(rotations):
        across = float(np.hypot(matrix[0, 0], matrix[1, 0]))
        middle = np.arctan2(-matrix[2, 0], across)
        if across < LOCKED:
            # The second row of Rz(-a) R = Ry(b) Rx(c) is (0, cos c, -sin c).
            c, s = np.cos(before[0]), np.sin(before[0])
            row = c * matrix[1] - s * matrix[0]
            candidates = [np.array([before[0], middle, np.arctan2(-row[2], row[1])])]
        else:
            first = np.arctan2(matrix[1, 0], matrix[0, 0])
            last = np.arctan2(matrix[2, 1], matrix[2, 2])
            candidates = [
                np.array([first, middle, last]),
                np.array([first + np.pi, np.pi - middle, last + np.pi]),
            ]
        wrapped = [
            one + 2.0 * np.pi * np.round((before - one) / (2.0 * np.pi)) for one in candidates
        ]
        before = min(wrapped, key=lambda one: float(np.abs(one - before).sum()))
        angles[index] = before
    return angles
