"""Rigid motions as text that, applied again, gives the same points."""

from __future__ import annotations

import math

import numpy as np

from regkit.system.arrays import Array

DIGITS = 6
"""Decimals of a translation, and least decimals of a rotation."""

MAX_ERROR = 1e-4
"""Largest distance by which rounding the rotation may move a point, in the unit of the clouds."""


def matrix_rows(transform: Array, points: Array) -> list[str]:
    """Returns the rows of a matrix (4, 4), with as many digits as the points need.

    Six decimals of a rotation move a point that is millions of metres from the origin by metres.

    Args:
        transform: The motion, (4, 4).
        points: Points to which it applies, (N, 3).
    """
    reach = float(np.abs(points).sum(axis=1).max())
    digits = max(DIGITS, math.ceil(math.log10(max(0.5 * reach / MAX_ERROR, 1.0))))
    # Adding zero removes the sign of a negative one.
    rotation = [[f"{value + 0.0:.{digits}f}" for value in row] for row in transform[:, :3]]
    translation = [f"{value + 0.0:.{DIGITS}f}" for value in transform[:, 3]]
    longest = max(map(len, translation))
    return [
        " ".join(cell.rjust(digits + 5) for cell in row) + " " + at.rjust(max(11, longest))
        for row, at in zip(rotation, translation, strict=True)
    ]
