"""Array types, and checks of arrays from users and files."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from regkit.system.errors import DataError

Array = NDArray[np.float64]
"""Array of real numbers; the docstring of each use gives the shape."""

Indices = NDArray[np.intp]
"""Array of integers that index another array."""


def read_only(values: ArrayLike) -> Array:
    """Returns a read-only copy of ``values`` as float64."""
    array = np.array(values, dtype=np.float64)
    array.flags.writeable = False
    return array


def checked_points(points: ArrayLike, *, place: str | None = None) -> Array:
    """Returns points from a user or a file as an array (N, 3) [m].

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
