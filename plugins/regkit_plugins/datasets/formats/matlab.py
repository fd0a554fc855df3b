"""Arrays with three axes in MATLAB files; the last axis counts the frames."""

from __future__ import annotations

from collections.abc import Iterator
from math import prod
from pathlib import Path
from typing import Any

import numpy as np

from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.guard import reading
from regkit_plugins.datasets.formats import hdf5

HDF5_MARK = b"MATLAB 7.3"
"""Magic bytes of MATLAB files in HDF5 format, whose axes are stored in reverse order."""

MAX_VALUES, MAX_EXPANSION = 1 << 26, 100
"""An array may have more than so many values only with a hundredth of them in bytes."""


def array_shape(path: Path, name: str) -> tuple[int, ...]:
    """Returns the shape of an array, without reading its values.

    Raises:
        DataError: If the file or the array is missing, damaged, or does not have three axes.
    """
    if _is_hdf5(path):
        with hdf5.opened(path) as file:
            return _checked(hdf5.stored(file, name).shape[::-1], path, name)
    from scipy.io import whosmat

    with reading(path, f"a .mat file with '{name}'"):
        shapes = {found: shape for found, shape, _ in whosmat(path)}
        shape = tuple(shapes[name])
    return _checked(shape, path, name)


def read_array(path: Path, name: str) -> Array:
    """Returns a whole array (A, B, T).

    Raises:
        DataError: If the file or the array is missing, damaged, or does not have three axes.
    """
    return np.stack(list(read_frames(path, name)), axis=2)


def read_frames(path: Path, name: str) -> Iterator[Array]:
    """Yields the frames (A, B) of an array (A, B, T).

    For a file of version 7.3 only one frame is in memory at a time. Older files must be unpacked as
    a whole, and are held in their stored type.

    Raises:
        DataError: If the file or the array is missing, damaged, or does not have three axes.
    """
    if _is_hdf5(path):
        with hdf5.opened(path) as file:
            array = hdf5.stored(file, name)
            for index in range(_checked(array.shape[::-1], path, name)[2]):
                yield np.asarray(hdf5.read(array, index), dtype=np.float64).T
        return
    values = _unpacked(path, name)
    for index in range(_checked(values.shape, path, name)[2]):
        yield np.asarray(values[:, :, index], dtype=np.float64)


def _unpacked(path: Path, name: str) -> np.ndarray[Any, Any]:
    from scipy.io import loadmat

    _check_size(path, name, array_shape(path, name))
    with reading(path, f"a .mat file with '{name}'"):
        values = loadmat(path, variable_names=[name])[name]
        if values.dtype.kind not in "biuf":
            raise TypeError(f"it holds {values.dtype}, which are not numbers")
        return np.asarray(values)


def _check_size(path: Path, name: str, shape: tuple[int, ...]) -> None:
    """Refuses an array that no file of this size holds, before it is unpacked."""
    size = prod(shape)
    if size > max(MAX_VALUES, MAX_EXPANSION * path.stat().st_size):
        raise DataError(
            f"{name} of shape {shape} would unpack to {size} values, far more than the file holds",
            place=str(path),
        )


def _checked(shape: tuple[int, ...], path: Path, name: str) -> tuple[int, ...]:
    if len(shape) != 3 or 0 in shape:
        raise DataError(
            f"{name} has the shape {shape}; it must have three axes, the frames last",
            place=str(path),
        )
    return shape


def _is_hdf5(path: Path) -> bool:
    try:
        with path.open("rb") as stream:
            return stream.read(len(HDF5_MARK)) == HDF5_MARK
    except FileNotFoundError:
        raise DataError("there is no such file", place=str(path)) from None
    except OSError as error:
        raise DataError(f"cannot be read: {error.strerror}", place=str(path)) from None
