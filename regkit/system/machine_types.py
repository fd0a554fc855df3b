"""Array types of compiled functions: annotations that fix element type, dimensions and layout.

A function that is compiled for explicit types compiles once, whoever calls it. Its annotations are
these types, numbers, tuples of both, and named tuples with such fields.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import NDArray

from regkit.system.optional import load_library


@dataclass(frozen=True)
class Contiguous:
    """A contiguous array in row-major order.

    Attributes:
        element: NumPy's name of the element type.
        dimensions: Number of dimensions.
    """

    element: str
    dimensions: int


Vector = Annotated[NDArray[np.float64], Contiguous("float64", 1)]
Matrix = Annotated[NDArray[np.float64], Contiguous("float64", 2)]
Stack = Annotated[NDArray[np.float64], Contiguous("float64", 3)]
"""Real numbers in one, two and three dimensions."""

SingleVector = Annotated[NDArray[np.float32], Contiguous("float32", 1)]
SingleMatrix = Annotated[NDArray[np.float32], Contiguous("float32", 2)]
"""Numbers in single precision, where there are many."""

IntegerVector = Annotated[NDArray[np.int64], Contiguous("int64", 1)]
IntegerMatrix = Annotated[NDArray[np.int64], Contiguous("int64", 2)]
IntegerStack = Annotated[NDArray[np.int64], Contiguous("int64", 3)]
"""Integers, such as indices."""

_SCALARS = {float: "float64", int: "int64", bool: "boolean", type(None): "none"}


def machine_type(annotation: Any) -> Any:
    """Returns Numba's type of an annotation; None if the annotation does not fix one."""
    types = load_library("numba").types
    if annotation in _SCALARS:
        return getattr(types, _SCALARS[annotation])
    if get_origin(annotation) is Annotated:
        array = next((one for one in get_args(annotation) if isinstance(one, Contiguous)), None)
        if array is None:
            return None
        return types.Array(getattr(types, array.element), array.dimensions, "C")
    named = isinstance(annotation, type) and issubclass(annotation, tuple)
    if named and hasattr(annotation, "_fields"):
        hints = get_type_hints(annotation, include_extras=True)
        parts = [machine_type(hints[field]) for field in annotation._fields]
        return None if None in parts else types.BaseTuple.from_types(parts, annotation)
    if get_origin(annotation) is tuple:
        parts = [machine_type(part) for part in get_args(annotation)]
        return None if None in parts else types.BaseTuple.from_types(parts)
    return None


@cache
def machine_signature(function: Any) -> Any:
    """Returns Numba's signature of a function; None if its annotations do not fix one."""
    hints = get_type_hints(function, include_extras=True)
    returned = machine_type(hints.pop("return", None))
    arguments = [machine_type(hint) for hint in hints.values()]
    return None if returned is None or None in arguments else returned(*arguments)
