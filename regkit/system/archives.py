"""Reading of ``.npz`` files that may be damaged or forged."""

from __future__ import annotations

from math import prod
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from regkit.system.errors import DataError
from regkit.system.guard import reading

LARGEST = 1 << 32
"""Maximum size of all arrays of a file [bytes]; more is taken for a forged header."""


def read_arrays(path: Path, what: str) -> dict[str, NDArray[Any]]:
    """Returns the arrays of a ``.npz`` file by name.

    The sizes in the file's headers are compared before memory is asked for.

    Args:
        path: The file.
        what: What it should be, for messages.

    Raises:
        DataError: If it is missing, damaged, or its headers lie.
    """
    with reading(path, what), path.open("rb") as stream:
        with ZipFile(stream) as archive:
            entries = archive.infolist()
            if sum(entry.file_size for entry in entries) > LARGEST:
                raise DataError(f"its arrays take more than {LARGEST >> 30} GiB")
            for entry in entries:
                _check_header(archive, entry.filename, entry.file_size)
        stream.seek(0)
        with np.load(stream, allow_pickle=False) as arrays:
            return {name: arrays[name] for name in arrays.files}


def _check_header(archive: ZipFile, name: str, size: int) -> None:
    with archive.open(name) as member:
        version = npy.read_magic(member)
        header = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
        shape, _, dtype = header(member)
        needed = prod(shape) * dtype.itemsize + member.tell()
    if needed != size:
        raise DataError(f"the header of '{name}' asks for {needed} bytes, and there are {size}")
