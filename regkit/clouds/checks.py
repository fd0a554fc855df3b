"""Whether clouds can be aligned at all; what cannot be is told before any work is done."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array
from regkit.system.errors import DataError

FEWEST = 10
"""So many different points are needed, which leaves some over after six degrees of freedom."""

FLAT = 1e-3
"""A cloud is a plane or a line if it is thinner than this part of its length."""

SIZES = 20.0
"""Clouds whose sizes differ by more than this factor do not show the same thing in one unit."""


def check_shape(points: Array, *, place: str) -> None:
    """Refuse a cloud (N, 3) whose alignment would not be determined.

    Raises:
        DataError: If it has too few different points, or they lie on a line or in a plane.
    """
    different = len(np.unique(points, axis=0))
    if different < FEWEST:
        raise DataError(
            f"the cloud has {different} different points of {len(points)}; at least {FEWEST} are "
            "needed",
            place=place,
        )
    lengths = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    if lengths[1] < FLAT * lengths[0]:
        raise DataError(
            "all points lie on a line, so that the rotation about it is not determined", place=place
        )
    if lengths[2] < FLAT * lengths[0]:
        raise DataError(
            "all points lie in a plane, so that motions in it and turning it over are not "
            "determined",
            place=place,
        )


def check_sizes(source: Array, target: Array) -> None:
    """Refuse clouds that cannot be in the same unit.

    Raises:
        DataError: If one is many times as large as the other.
    """
    sizes = [float(np.linalg.norm(np.ptp(points, axis=0))) for points in (source, target)]
    factor = max(sizes) / min(sizes)
    if factor <= SIZES:
        return
    hint = " (one in millimetres, the other in metres?)" if 200.0 < factor < 5000.0 else ""
    raise DataError(
        f"the source is {sizes[0]:.4g} large and the target {sizes[1]:.4g}, a factor of "
        f"{factor:.3g}; bring both to the same unit{hint}, or crop the larger one"
    )
