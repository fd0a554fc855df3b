"""Arrays from what a pickle recorded: NumPy's, SciPy's sparse ones, and chumpy's."""

from __future__ import annotations

import re
from collections.abc import Mapping
from math import prod
from typing import Any

import numpy as np
import scipy

from regkit.interchange.body_model.pickles import Recorded
from regkit.system.errors import DataError

Numbers = np.ndarray[Any, np.dtype[Any]]

LARGEST = 1 << 27
"""Number of elements of the largest dense array; shape modes of SMPL-X have 13 million."""

DEEPEST = 8
"""Number of arrays that an array of chumpy may refer to in a chain."""

_CODE = re.compile(r"[biuf][1248]")
_CHUMPY = ("chumpy.Ch", "chumpy.ch.Ch")
_SELECT = ("chumpy.reordering.Select", "chumpy.Select")


def array_of(value: Any, depth: int = 0) -> Numbers:
    """Returns the dense array of numbers that a pickle describes.

    Args:
        value: An array, a recorded array of NumPy or chumpy, or a recorded sparse matrix.
        depth: Number of arrays of chumpy that refer to it.

    Raises:
        DataError: If it is something else, or not what it says.
    """
    if isinstance(value, np.ndarray):
        return value
    if not isinstance(value, Recorded):
        raise DataError(f"is of the type {type(value).__name__}; it needs an array")
    if depth > DEEPEST:
        raise DataError(f"is a chain of more than {DEEPEST} arrays of chumpy")
    state = value.state if isinstance(value.state, Mapping) else {}
    origin = _made(value)
    if origin in _CHUMPY and "x" in state:
        return array_of(state["x"], depth + 1)
    if origin in _SELECT and {"a", "idxs"} <= set(state):
        return _selected(state, depth + 1)
    if origin.startswith("scipy.sparse."):
        return _dense(origin.rpartition(".")[2][:3], state, depth + 1)
    if origin == "numpy.core.multiarray._reconstruct":
        _, shape, dtype, fortran, data = _fields(value.state, 5)
        return _array(data, dtype, shape, "F" if fortran else "C")
    if origin == "numpy.core.numeric._frombuffer":
        data, dtype, shape, order = _fields(value.args, 4)
        return _array(data, dtype, shape, "F" if order == "F" else "C")
    if origin.startswith("chumpy"):
        raise DataError(
            f"is computed by '{origin}' from other arrays; write its values into the file, such as "
            "by `tools/clean_ch.py` of the package smplx"
        )
    raise DataError(f"is a '{origin}'; it needs an array")


def content_of(value: Any) -> Any:
    """Returns the one Python object in a recorded array of objects.

    Raises:
        DataError: If there is not exactly one.
    """
    state = value.state if isinstance(value, Recorded) else None
    if isinstance(state, tuple) and len(state) == 5 and isinstance(state[4], list):
        items = state[4]
        if len(items) == 1:
            return items[0]
    raise DataError("holds Python objects, and not one of them")


def _made(value: Recorded) -> str:
    """Returns the name of a recorded object's class."""
    if value.origin == "copyreg._reconstructor" and value.args:
        return str(getattr(value.args[0], "origin", ""))
    return value.origin


def _fields(values: Any, count: int) -> tuple[Any, ...]:
    if not isinstance(values, tuple) or len(values) != count:
        raise DataError("is a damaged array")
    return values


def _array(data: Any, dtype: Any, shape: Any, order: Any) -> Numbers:
    """Returns the array in the bytes of a pickle."""
    numbers = _dtype(dtype)
    shape = _shape(shape if isinstance(shape, (tuple, list)) else (shape,))
    content, asked = _bytes(data), prod(shape) * numbers.itemsize
    if len(content) != asked:
        raise DataError(
            f"has the shape {shape} and the type {numbers}, which need {asked} bytes; the file "
            f"holds {len(content)}"
        )
    return np.frombuffer(content, dtype=numbers).reshape(shape, order=order)


def _dtype(value: Any) -> np.dtype[Any]:
    code = value.args[0] if isinstance(value, Recorded) and value.args else None
    if value is None or value.origin != "numpy.dtype" or not isinstance(code, str):
        raise DataError("has no type")
    if not _CODE.fullmatch(code):
        raise DataError(f"is of the type '{code}'; it needs numbers")
    state = value.state
    big = isinstance(state, tuple) and len(state) > 1 and state[1] in (">", b">")
    return np.dtype(code).newbyteorder(">" if big else "<")


def _bytes(data: Any) -> bytes:
    if isinstance(data, Recorded) and data.origin == "_codecs.encode":
        # Python 3 writes bytes for Python 2 as text that is encoded again.
        data = data.args[0] if data.args else None
    if isinstance(data, str):
        return data.encode("latin1")
    if isinstance(data, (bytes, bytearray)):
        return bytes(data)
    raise DataError("holds Python objects in place of numbers")


def _selected(state: Mapping[str, Any], depth: int) -> Numbers:
    """Returns elements of another array by their places, as ``chumpy.reordering.Select`` does."""
    elements, places = array_of(state["a"], depth).ravel(), array_of(state["idxs"], depth)
    if (
        places.dtype.kind not in "iu"
        or not ((places >= 0) & (places < max(len(elements), 1))).all()
    ):
        raise DataError("selects elements that do not exist")
    selected, shape = elements[places], state.get("preferred_shape")
    return selected if shape is None else selected.reshape(_shape(shape))


def _dense(layout: str, state: Mapping[str, Any], depth: int) -> Numbers:
    """Returns a sparse matrix as a dense array."""
    shape = _shape(state.get("_shape", state.get("shape")))
    if len(shape) != 2 or not 0 < prod(shape) <= LARGEST:
        raise DataError(f"is a sparse matrix of the shape {shape}; it is empty or too large")
    if layout == "coo":
        places = state.get("coords", (state.get("row"), state.get("col")))
    else:
        places = (state.get("indices"), state.get("indptr"))
    data, first, second = (
        array_of(one, depth).ravel() for one in (state.get("data"), *_fields(places, 2))
    )
    if layout == "coo":
        return np.asarray(scipy.sparse.coo_array((data, (first, second)), shape=shape).toarray())
    made: Any = scipy.sparse.csc_array if layout == "csc" else scipy.sparse.csr_array
    matrix = made((data, first, second), shape=shape)
    matrix.check_format(full_check=True)
    return np.asarray(matrix.toarray())


def _shape(lengths: Any) -> tuple[int, ...]:
    """Returns a shape, whose lengths may be integers of NumPy."""
    shape = lengths if isinstance(lengths, (tuple, list)) else (None,)
    found = tuple(_integer(length) for length in shape)
    if not all(length >= 0 for length in found):
        raise DataError("has no shape")
    return found


def _integer(value: Any) -> int:
    """Returns an integer of Python or NumPy; -1 for anything else."""
    if isinstance(value, Recorded) and value.origin == "numpy.core.multiarray.scalar":
        dtype, data = _fields(value.args, 2)
        number = _array(data, dtype, (), "C")
        return int(number) if number.dtype.kind in "iu" else -1
    return value if isinstance(value, int) else -1
