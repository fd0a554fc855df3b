"""Checks that arrays from a program can be measurements in metres."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from regkit.system.arrays import Array
from regkit.system.errors import DataError


def checked_numbers(values: ArrayLike, *, place: str, whole: bool = False) -> Array:
    """Returns values as an array of floating-point numbers.

    Args:
        values: The argument of the program.
        place: Name of the argument in messages.
        whole: Whether integers are allowed; for lengths in metres they indicate a wrong unit.

    Raises:
        DataError: If the values are not numbers, or integers in place of lengths in metres.
    """
    try:
        # np.asarray would read what is masked.
        masked = isinstance(values, np.ma.MaskedArray) and values.dtype.kind == "f"
        array = np.ma.filled(values, np.nan) if masked else np.asarray(values)
    except ValueError:
        raise DataError("not an array: its rows differ in length", place=place) from None
    if array.dtype.kind in "iu" and not whole:
        raise DataError(
            f"numbers of type {array.dtype}; lengths must be floating-point numbers in metres: "
            "divide by the units per metre, as in depth / 1000.0 for millimetres",
            place=place,
        )
    if array.dtype.kind not in "iuf":
        raise DataError(f"values must be numbers; they are of type {array.dtype}", place=place)
    return array.astype(np.float64)
