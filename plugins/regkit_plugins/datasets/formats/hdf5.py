"""Reading of HDF5 files."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from regkit.system.errors import DataError
from regkit.system.guard import foreign, reading
from regkit.system.optional import load_library

MAX_BYTES = 1 << 28
"""Largest part of an array that is read at once."""


@contextmanager
def opened(path: Path) -> Iterator[Any]:
    """Context manager of an HDF5 file opened for reading.

    Raises:
        DataError: If it is missing, damaged, or not an HDF5 file.
        DependencyError: If h5py is not installed.
    """
    h5py = load_library("h5py", install="pip install 'regkit[hdf5]'")
    if not path.is_file():
        raise DataError("there is no such file", place=str(path))
    with reading(path, "an HDF5 file, or damaged"), h5py.File(path, "r") as file:
        yield file


def stored(file: Any, name: str) -> Any:
    """Returns the array ``name`` of an open file, without reading its values.

    Raises:
        DataError: If there is no such array.
    """
    found = file.get(name)
    if found is None or not isinstance(getattr(found, "shape", None), tuple):
        raise DataError(
            f"no array '{name}' in the file (there are: {', '.join(sorted(file))})",
            place=file.filename,
        )
    return found


def read(array: Any, where: Any = ()) -> Any:
    """Returns the part ``where`` of an array of an open file.

    Raises:
        DataError: If that part is damaged.
    """
    # A header may announce terabytes that were never written.
    share = 1.0 if isinstance(where, tuple) else np.size(where) / max(1, array.shape[0])
    if share * array.size * array.dtype.itemsize > MAX_BYTES:
        raise DataError(
            f"'{array.name.lstrip('/')}' of shape {array.shape} would take more than "
            f"{MAX_BYTES >> 20} MB at once",
            place=array.file.filename,
        )
    try:
        return array[where]
    except Exception as error:
        raise DataError(
            f"'{array.name.lstrip('/')}' cannot be read: {foreign(error)}",
            place=array.file.filename,
        ) from None
