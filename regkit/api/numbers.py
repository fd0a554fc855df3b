"""Whether arrays from a program can be measurements, and in metres."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from regkit.system.arrays import Array
from regkit.system.errors import DataError

TOO_LARGE, TOO_SMALL = 200.0, 0.02
"""Data that are so many times as large as a body are not in metres."""


def checked_numbers(values: ArrayLike, *, place: str, whole: bool = False) -> Array:
    """Floating-point numbers as they are, or an error.

    Args:
        values: What a program gave.
        place: What they are called in messages.
        whole: Whether integers will do as well; lengths in metres are none.

    Raises:
        DataError: If they are no numbers, or integers where lengths in metres are wanted.
    """
    try:
        array = np.asarray(values)
    except ValueError:
        raise DataError("not an array: its rows differ in length", place=place) from None
    if array.dtype.kind in "iu" and not whole:
        raise DataError(
            f"numbers of the type {array.dtype}; lengths are metres, as floating-point numbers: "
            "divide by the units in a metre, as in depth / 1000.0 where they are millimetres",
            place=place,
        )
    if array.dtype.kind not in "iuf":
        raise DataError(f"numbers are wanted, these are of the type {array.dtype}", place=place)
    return array.astype(np.float64)


def check_metres(points: Array, sizes: tuple[float, ...], *, place: str) -> None:
    """Refuse data that are in another unit than a template.

    Args:
        points: (N, 3) as they were measured, with all that is around the body.
        sizes: Of the template [m].
        place: What the points are called in messages.

    Raises:
        DataError: If they are much larger or smaller than the template.
    """
    if not len(points):
        return
    low, high = np.percentile(points, [1.0, 99.0], axis=0)
    extent = float(np.linalg.norm(high - low))
    hint = f"; the template is {sizes[0]:.3g} to {sizes[-1]:.3g} m" if len(sizes) > 1 else ""
    hint = hint or f"; the template is {sizes[0]:.3g} m"
    if extent > TOO_LARGE * sizes[-1]:
        raise DataError(
            f"the points are spread over {extent:.4g} m{hint}. Are they millimetres? Divide them "
            "by 1000.0",
            place=place,
        )
    if extent < TOO_SMALL * sizes[0]:
        raise DataError(
            f"the points are spread over {extent:.4g} m only{hint}. Bring them to metres, or give "
            "the template's size",
            place=place,
        )
