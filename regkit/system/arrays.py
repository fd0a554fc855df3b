"""Array types, and checks of arrays from users and files."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from regkit.system.errors import DataError
from regkit.system.notes import note

Array = NDArray[np.float64]
"""Array of real numbers; the docstring of each use gives the shape."""

Singles = NDArray[np.float32]
"""Array of real numbers in single precision, where there are many."""

Indices = NDArray[np.intp]
"""Array of integers that index another array."""


MAX_COORDINATE = 1e12
"""Largest coordinate that can be a measurement, in any unit from micrometres to metres."""


def real_numbers(stored: NDArray[Any], what: str) -> Array:
    """Returns a stored array as float64 in row-major order, as compiled loops need it.

    Args:
        stored: The array, of any type.
        what: Its name, for messages.

    Raises:
        DataError: If it holds no real numbers, such as text or times.
    """
    if stored.dtype.kind not in "fiub":
        raise DataError(f"{what} is of the type {stored.dtype}; it needs numbers")
    return np.array(stored, dtype=np.float64, order="C")


def whole_numbers(stored: NDArray[Any], what: str) -> Indices:
    """Returns a stored array of integers as indices.

    Args:
        stored: The array, of any type.
        what: Its name, for messages.

    Raises:
        DataError: If it holds anything else than integers.
    """
    if stored.dtype.kind not in "iu":
        raise DataError(f"{what} is of the type {stored.dtype}; it needs integers")
    return np.array(stored, dtype=np.intp)


def loop_input(values: NDArray[Any]) -> Array:
    """Returns an array as float64 in row-major order and writeable; a copy only if it is not.

    Compiled loops compile anew for arrays of another kind.
    """
    if values.dtype == np.float64 and values.flags.carray:
        return values
    return np.require(values, np.float64, ["C", "A", "W"])


def read_only(values: ArrayLike) -> Array:
    """Returns a read-only copy of ``values`` as float64."""
    array = np.array(values, dtype=np.float64)
    array.flags.writeable = False
    return array


def checked_points(points: ArrayLike, *, place: str | None = None) -> Array:
    """Returns points (N, 3) [m] that must all be finite, such as those of a frame.

    Raises:
        DataError: If the shape is not (N, 3), or a coordinate is not finite or absurdly large.
    """
    array = np.asarray(points, dtype=np.float64)
    if len(measured_points(array, place=place)) < len(array):
        bad = np.flatnonzero(~np.isfinite(array).all(axis=1))
        raise DataError(
            f"{len(bad)} of {len(array)} points have a NaN or infinite coordinate, first at "
            f"point {bad[0]}: {array[bad[0]].tolist()}; remove them",
            place=place,
        )
    return array


MARKS = (9999.0, 99999.0, 999999.0, 32768.0)
"""Numbers, of either sign, that some programs write for a missing measurement."""


def without_missing(points: ArrayLike, *, place: str | None = None) -> Array:
    """Returns the measured points (M, 3) [m] of points (N, 3) from a user or a file.

    Sensors write NaN or infinity where they measured nothing; such rows are dropped, and told.

    Raises:
        DataError: If the shape is not (N, 3), a coordinate is absurdly large, or all rows are
            missing measurements.
    """
    array = np.asarray(points, dtype=np.float64)
    measured = measured_points(array, place=place)
    missing = len(array) - len(measured)
    if missing and not len(measured):
        raise DataError(
            f"all {missing} points are missing measurements (NaN or infinite)", place=place
        )
    if missing:
        note(
            f"{missing} of {len(array)} points are missing measurements (NaN or infinite) and are "
            f"dropped; {len(measured)} remain",
            place=place,
        )
    _tell_marks(measured, place)
    return measured


def measured_points(points: ArrayLike, *, place: str | None = None) -> Array:
    """Returns the finite rows (M, 3) of points (N, 3) [m], without a word about the others.

    Raises:
        DataError: If the shape is not (N, 3), or a coordinate is beyond ``MAX_COORDINATE``.
    """
    array = np.asarray(points, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 3:
        raise DataError(f"points have the shape {array.shape}; they must be (N, 3)", place=place)
    # No comparison holds for NaN, so two reductions tell that all is well.
    if not len(array) or (array.max() <= MAX_COORDINATE and array.min() >= -MAX_COORDINATE):
        return array
    finite = np.isfinite(array).all(axis=1)
    measured = array if finite.all() else array[finite]
    far = np.flatnonzero((np.abs(measured) > MAX_COORDINATE).any(axis=1))
    if len(far):
        at = int(np.flatnonzero(finite)[far[0]])
        raise DataError(
            f"point {at} is {array[at].tolist()}; a coordinate beyond {MAX_COORDINATE:g} is no "
            "measurement: the file is damaged, or of another format",
            place=place,
        )
    return measured


def _tell_marks(points: Array, place: str | None) -> None:
    """Tells of points (N, 3) that look like marks of missing measurements."""
    origin = ~points.any(axis=1)
    marked = np.isin(np.abs(points), MARKS).any(axis=1)
    # One point may well be the origin.
    for rows, what in ((marked, "have such a coordinate as in"), (origin, "are exactly")):
        if np.count_nonzero(rows) > 1:
            count, first = np.count_nonzero(rows), points[np.flatnonzero(rows)[0]].tolist()
            note(
                f"{count} of {len(points)} points {what} {first}, which may mark a missing "
                "measurement, and are kept; remove them, or write nan",
                place=place,
            )
