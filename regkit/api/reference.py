"""Reference joints in the forms that programs use."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from regkit.api.numbers import checked_numbers
from regkit.body import Body
from regkit.observation import Truth
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError

Reference = Truth | Mapping[str, ArrayLike] | ArrayLike
"""Reference joints: a ``Truth``, arrays (T, 3) [m] by name, or one array (T, M, 3) [m] for all
markers; NaN for unseen joints."""


def truth_of(reference: Reference, body: Body, numbers: Sequence[int]) -> Truth:
    """Returns reference joints as a ``Truth``.

    Args:
        reference: The argument of the program.
        body: The body whose markers are compared with the joints.
        numbers: Frame numbers (T) in the recording of a ``Truth``.

    Raises:
        ConfigError: If no joint has the name of a marker.
        DataError: If an array has the wrong shape, or frames are missing.
    """
    markers, frames = body.markers.names, len(numbers)
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
        known, needed = len(reference.positions), max(numbers) + 1
        if known < needed:
            raise DataError(f"it has {known} frames, but {needed} were tracked", place="truth")
        return replace(reference, positions=reference.positions[list(numbers)])
    columns = [_checked(at, (frames, 3), f"truth['{name}']") for name, at in reference.items()]
    return Truth(names, np.stack(columns, axis=1))


def _checked(values: ArrayLike, shape: tuple[int, ...], place: str) -> Array:
    array = checked_numbers(values, place=place)
    if array.shape != shape:
        raise DataError(f"an array of shape {array.shape}; it must be {shape}", place=place)
    return array
