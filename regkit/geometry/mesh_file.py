"""The arrays of a mesh file, checked."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from regkit.system.archives import read_arrays
from regkit.system.arrays import Array, Indices
from regkit.system.errors import DataError
from regkit.system.notes import note
from regkit.system.printable import is_name, shortened

ROUNDED = 0.03
"""Weights whose sum is further from one are more than rounded to eight bits."""

RIGID = 0.02
"""Largest deviation of a bone's axes from a rotation."""

FARTHEST = 1e6
"""Coordinate that no skin has, in metres or millimetres."""

MAX_BONES = 10_000
"""Number of bones that no skeleton has."""

SHOWN = 5
"""Number of wrong names that a message lists."""

Arrays = dict[str, np.ndarray[Any, np.dtype[Any]]]


def mesh_arrays(path: Path, keys: Sequence[str]) -> Arrays:
    """Returns the named arrays of an ``.npz`` file.

    Raises:
        DataError: If the file is missing or damaged, or lacks one of the arrays.
    """
    return read_arrays(path, keys, f"a skinned mesh, an .npz file with {', '.join(keys)}")


def checked_shape(arrays: Arrays, key: str, *shape: int | None, most: float = np.inf) -> Array:
    """Returns an array of finite numbers of a shape.

    Args:
        arrays: The arrays by name.
        key: Name of the array.
        shape: The shape; None stands for any length.
        most: The largest absolute value.

    Raises:
        DataError: If the shape differs, or a number is not finite or beyond ``most``.
    """
    array = arrays[key]
    fits = array.ndim == len(shape) and all(
        wanted in (None, length) for wanted, length in zip(shape, array.shape, strict=False)
    )
    if not fits or array.dtype.kind not in "fiu":
        wanted = ", ".join("any" if length is None else str(length) for length in shape)
        raise DataError(
            f"{key} has the shape {array.shape} and the type {array.dtype}; it needs numbers of "
            f"the shape ({wanted})"
        )
    numbers = array.astype(np.float64)
    bad = ~np.isfinite(numbers).reshape(len(numbers), -1).all(axis=1)
    if bad.any():
        raise DataError(f"{key} has NaN or infinite numbers, first in row {int(np.argmax(bad))}")
    if (largest := float(np.abs(numbers).max(initial=0.0))) > most:
        raise DataError(f"{key} holds {largest:g}, which cannot be right; the most is {most:g}")
    return numbers


def checked_indices(arrays: Arrays, key: str, columns: int | None, low: int, high: int) -> Indices:
    """Returns an array (N, columns) of indices from ``low`` to below ``high``.

    Raises:
        DataError: If one is not.
    """
    numbers = checked_shape(arrays, key, None, columns)
    wrong = ((numbers < low) | (numbers >= high) | (numbers % 1.0 != 0.0)).reshape(len(numbers), -1)
    if wrong.any():
        row = int(np.argmax(wrong.any(axis=1)))
        raise DataError(
            f"{key} has {arrays[key][row].tolist()} in row {row}; it must be whole numbers from "
            f"{low} to {high - 1}"
        )
    return numbers.astype(np.intp)


def checked_weights(arrays: Arrays, key: str, path: Path) -> Array:
    """Returns skinning weights (V, A), whose rows sum to one.

    Raises:
        DataError: If a weight is negative, or a vertex has none.
    """
    weights = checked_shape(arrays, key, None, None)
    sums = weights.sum(axis=1, keepdims=True)
    wrong = (weights < 0.0).any(axis=1) | (sums[:, 0] <= 0.0)
    if wrong.any():
        row = int(np.argmax(wrong))
        raise DataError(
            f"{key} has {weights[row].tolist()} in row {row}; weights must not be negative, and "
            "each vertex needs one"
        )
    uneven = np.abs(sums[:, 0] - 1.0) > ROUNDED
    if uneven.any():
        row = int(np.argmax(uneven))
        note(
            f"{key} of {int(uneven.sum())} vertices do not sum to 1, those of vertex {row} to "
            f"{sums[row, 0]:.4g}; they are divided by their sums",
            place=path,
        )
        return np.asarray(weights / sums)
    return weights


def checked_bones(arrays: Arrays, poses: str, count: int) -> Array:
    """Returns the poses (J, 4, 4) of bones, which are rigid transforms.

    Raises:
        DataError: If one is not.
    """
    rest = checked_shape(arrays, poses, count, 4, 4, most=FARTHEST)
    turns = rest[:, :3, :3]
    off = np.abs(turns @ turns.swapaxes(1, 2) - np.eye(3)).max(axis=(1, 2), initial=0.0)
    wrong = (off > RIGID) | (np.linalg.det(turns) < 0.0)
    wrong |= (np.abs(rest[:, 3] - [0.0, 0.0, 0.0, 1.0]) > 1e-6).any(axis=1)
    if wrong.any():
        bone = int(np.argmax(wrong))
        raise DataError(
            f"{poses} of bone {bone} is no rigid transform, scaled or mirrored: "
            f"{rest[bone].round(3).tolist()}"
        )
    return rest


def checked_labels(arrays: Mapping[str, Any], labels: str, parents: str) -> tuple[str, ...]:
    """Returns the names of bones, whose parents come first.

    Raises:
        DataError: If there are none or too many, names are not unique, or a parent does not come
            first.
    """
    stored = np.atleast_1d(arrays[labels]).ravel()
    if stored.dtype.kind not in "US":
        raise DataError(f"{labels} is of the type {stored.dtype}; it needs names")
    names = tuple(stored.astype(np.str_).tolist())
    if not 0 < len(names) <= MAX_BONES:
        raise DataError(f"{labels} has {len(names)} names; it needs one to {MAX_BONES}")
    odd = [name for name in names if not is_name(name)]
    if odd:
        raise DataError(f"{labels} has '{shortened(odd[0])}', which cannot be printed")
    twice = sorted(name for name, count in Counter(names).items() if count > 1)
    if twice:
        raise DataError(f"{labels} must be unique names; repeated: {', '.join(twice[:SHOWN])}")
    above = np.atleast_1d(arrays[parents])
    if above.shape != (len(names),):
        raise DataError(f"{labels} has {len(names)} names, and {parents} the shape {above.shape}")
    for bone, parent in enumerate(above.tolist()):
        if not (parent == -1 if bone == 0 else 0 <= parent < bone):
            raise DataError(
                f"{parents} has {parent} for bone {bone}; the first bone has -1, and others one "
                "that comes before them"
            )
    return names
