"""Reference joints in the forms in which a program has them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from regkit.api.numbers import checked_numbers
from regkit.body import Body
from regkit.observation import Truth
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError

Reference = Truth | Mapping[str, ArrayLike] | ArrayLike
"""Reference joints: a ``Truth``, arrays (T, 3) [m] by name, or one (T, M, 3) [m] for all markers;
NaN where one was not seen."""


def truth_of(reference: Reference, body: Body, indices: range) -> Truth:
    """Reference joints as one type.

    Args:
        reference: As it was given.
        body: Whose markers are compared with them.
        indices: The numbers of the T frames in the recording that a ``Truth`` is of.

    Raises:
        ConfigError: If no name is that of a marker.
        DataError: If an array does not have the shape that it must have, or frames are missing.
    """
    markers, frames = body.markers.names, len(indices)
    if not isinstance(reference, (Truth, Mapping)):
        values = _checked(reference, (frames, len(markers), 3), "truth")
        return Truth(markers, values)
    names = reference.joints if isinstance(reference, Truth) else tuple(reference)
    if not set(names) & set(markers):
        raise ConfigError(
            f"none of its joints ({', '.join(names)}) is a marker of '{body.name}' "
            f"({', '.join(markers)})",
            place="truth",
        )
    if isinstance(reference, Truth):
        known, needed = len(reference.positions), max(indices) + 1
        if known < needed:
            raise DataError(f"it has {known} frames, but {needed} were tracked", place="truth")
        return replace(reference, positions=reference.positions[list(indices)])
    columns = [_checked(at, (frames, 3), f"truth['{name}']") for name, at in reference.items()]
    return Truth(names, np.stack(columns, axis=1))


def _checked(values: ArrayLike, shape: tuple[int, ...], place: str) -> Array:
    array = checked_numbers(values, place=place)
    if array.shape != shape:
        raise DataError(f"an array of shape {array.shape}; it must be {shape}", place=place)
    return array
