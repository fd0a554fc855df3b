"""Checks that arrays from a program can be measurements in metres."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from regkit.system.arrays import Array
from regkit.system.errors import DataError

TOO_LARGE, TOO_SMALL = 200.0, 0.02
"""Ratio of the data's extent to the template's size above which the unit must be wrong."""


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


def check_metres(points: Array, sizes: tuple[float, ...], *, place: str) -> None:
    """Refuses data in another unit than the template.

    Args:
        points: (N, 3), the body and its surroundings.
        sizes: Possible sizes of the template [m].
        place: Name of the points in messages.

    Raises:
        DataError: If the points' extent is much larger or smaller than the template.
    """
    if not len(points):
        return
    low, high = np.percentile(points, [1.0, 99.0], axis=0)
    extent = float(np.linalg.norm(high - low))
    hint = f"; the template is {sizes[0]:.3g} to {sizes[-1]:.3g} m" if len(sizes) > 1 else ""
    hint = hint or f"; the template is {sizes[0]:.3g} m"
    if extent > TOO_LARGE * sizes[-1]:
        raise DataError(
            f"the points are spread over {extent:.4g} m{hint}. If they are in millimetres, "
            "divide them by 1000.0",
            place=place,
        )
    if extent < TOO_SMALL * sizes[0]:
        raise DataError(
            f"the points are spread over only {extent:.4g} m{hint}. Convert them to metres, or "
            "give the template's size",
            place=place,
        )
