"""Array types and the checks that every array from outside passes."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from regkit.system.errors import DataError

Array = NDArray[np.float64]
"""Real numbers; the docstring at hand gives the shape."""

Indices = NDArray[np.intp]
"""Whole numbers that index another array."""


def read_only(values: ArrayLike) -> Array:
    """A copy of ``values`` as float64 that refuses to be written to."""
    array = np.array(values, dtype=np.float64)
    array.flags.writeable = False
    return array


def checked_points(points: ArrayLike, *, place: str | None = None) -> Array:
    """Points from outside as an (N, 3) array [m].

    Raises:
        DataError: If the shape is not (N, 3), or a coordinate is NaN or infinite.
    """
    array = np.asarray(points, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 3:
        raise DataError(f"points have the shape {array.shape}; they must be (N, 3)", place=place)
    bad = ~np.isfinite(array).all(axis=1)
    if bad.any():
        first = int(np.flatnonzero(bad)[0])
        raise DataError(
            f"{int(bad.sum())} of {len(array)} points have a NaN or infinite coordinate, first at "
            f"point {first}: {array[first].tolist()}; remove them",
            place=place,
        )
    return array
