"""Arrays of three axes in MATLAB's files, of which the last counts the frames."""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit_plugins.datasets.formats import hdf5

HDF5_MARK = b"MATLAB 7.3"
"""How the files begin that are HDF5 inside; their axes are stored in the reverse order."""


def array_shape(path: Path, name: str) -> tuple[int, ...]:
    """The shape of an array, of which nothing else is read.

    Raises:
        DataError: If the file or the array is missing, damaged, or has other axes.
    """
    if _is_hdf5(path):
        with hdf5.opened(path) as file:
            return _checked(hdf5.stored(file, name).shape[::-1], path, name)
    from scipy.io import whosmat

    with _blaming(path, name):
        shapes = {found: shape for found, shape, _ in whosmat(path)}
        shape = tuple(shapes[name])
    return _checked(shape, path, name)


def read_array(path: Path, name: str) -> Array:
    """An array (A, B, T) as a whole.

    Raises:
        DataError: If the file or the array is missing, damaged, or has other axes.
    """
    return np.stack(list(read_frames(path, name)), axis=2)


def read_frames(path: Path, name: str) -> Iterator[Array]:
    """The frames (A, B) of an array (A, B, T), one by one.

    Of a file of version 7.3 only one frame is in memory at a time. An older one can only be
    unpacked as a whole; it is held in the type in which it is stored.

    Raises:
        DataError: If the file or the array is missing, damaged, or has other axes.
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

    with _blaming(path, name):
        values = loadmat(path, variable_names=[name])[name]
        if values.dtype.kind not in "biuf":
            raise TypeError(f"it holds {values.dtype}, which are no numbers")
        return np.asarray(values)


@contextmanager
def _blaming(path: Path, name: str) -> Iterator[None]:
    """What SciPy raises at a damaged file, as an error that names it."""
    from scipy.io.matlab import MatReadError

    broken = (OSError, ValueError, KeyError, TypeError, NotImplementedError, zlib.error)
    try:
        yield
    except (*broken, MatReadError) as error:
        raise DataError(f"not a .mat file with '{name}': {error}", place=str(path)) from None


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
