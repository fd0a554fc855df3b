"""Reading of NumPy's ``.npz`` archives, whose headers may ask for more than the file holds."""

from __future__ import annotations

import zipfile
from collections.abc import Iterable
from math import prod
from pathlib import Path
from typing import IO, Any

import numpy as np

from regkit.system.errors import DataError
from regkit.system.guard import reading
from regkit.system.printable import shortened

FREE_BYTES = 1 << 26
"""Size of an array that is unpacked whatever the size of its file."""

MAX_EXPANSION = 100
"""Largest ratio of an array's size to that of its file; measured data shrinks tenfold at best."""


def read_arrays(
    path: Path, names: Iterable[str] | None = None, what: str = "an .npz file"
) -> dict[str, np.ndarray[Any, Any]]:
    """Returns named arrays of an ``.npz`` file, without executing anything in it.

    Args:
        path: The file.
        names: Names of the arrays; all by default.
        what: What the file should be, for messages.

    Raises:
        DataError: If the file or an array is missing or damaged, or an array is not of numbers or
            strings, or its header asks for more than the file can hold.
    """
    with reading(path, what), path.open("rb") as stream, zipfile.ZipFile(stream) as archive:
        wanted = _names(archive) if names is None else names
        return {name: _member(archive, name, path, what) for name in wanted}


def array_names(path: Path, what: str = "an .npz file") -> list[str]:
    """Returns the names of the arrays in an ``.npz`` file.

    Raises:
        DataError: If the file is missing or damaged.
    """
    with reading(path, what), path.open("rb") as stream, zipfile.ZipFile(stream) as archive:
        return _names(archive)


def object_pickle(path: Path, name: str) -> bytes | None:
    """Returns the pickle of an array of Python objects, which is not read; None for other arrays.

    Args:
        path: The ``.npz`` file.
        name: Name of the array.

    Raises:
        DataError: If the file or the array is missing or damaged.
    """
    what = "an .npz file"
    with reading(path, what), path.open("rb") as stream, zipfile.ZipFile(stream) as archive:
        info = _info(archive, name, path, what)
        with archive.open(info) as member:
            _, dtype = _header(member, name)
            return member.read() if dtype.hasobject else None


def _names(archive: zipfile.ZipFile) -> list[str]:
    return [name.removesuffix(".npy") for name in archive.namelist()]


def _info(archive: zipfile.ZipFile, name: str, path: Path, what: str) -> zipfile.ZipInfo:
    """Returns the entry of an array, which exists once and is not too large."""
    names = _names(archive)
    if names.count(name) != 1:
        found = "several arrays" if name in names else "no array"
        raise DataError(
            f"not {what}: there is {found} '{name}' (there are: {shortened(', '.join(names), 200)})"
        )
    info = archive.infolist()[names.index(name)]
    if info.file_size > max(FREE_BYTES, MAX_EXPANSION * path.stat().st_size):
        raise DataError(
            f"array '{name}' would unpack to {info.file_size / 1e9:.3g} GB, more than "
            f"{MAX_EXPANSION} times the size of the file; it holds no measured data"
        )
    return info


def _header(member: IO[bytes], name: str) -> tuple[tuple[int, ...], np.dtype[Any]]:
    """Returns the shape and the type of an array."""
    version = np.lib.format.read_magic(member)
    read = {
        (1, 0): np.lib.format.read_array_header_1_0,
        (2, 0): np.lib.format.read_array_header_2_0,
    }.get(version)
    if read is None:
        raise DataError(f"array '{name}' has the unknown format {version}")
    shape, _, dtype = read(member)
    return shape, dtype


def _member(archive: zipfile.ZipFile, name: str, path: Path, what: str) -> np.ndarray[Any, Any]:
    info = _info(archive, name, path, what)
    with archive.open(info) as member:
        shape, dtype = _header(member, name)
        asked, held = prod(shape) * dtype.itemsize, info.file_size - member.tell()
    if dtype.hasobject:
        raise DataError(f"array '{name}' holds Python objects, which are never read")
    if asked != held:
        raise DataError(
            f"array '{name}' of shape {shape} and type {dtype} needs {asked} bytes; the file holds "
            f"{held}"
        )
    with archive.open(info) as member:
        return np.asarray(np.lib.format.read_array(member, allow_pickle=False))
