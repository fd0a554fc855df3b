"""Atomic writing of files and folders."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from uuid import uuid4

import numpy as np

from regkit.system.arrays import Array
from regkit.system.errors import DataError


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Context manager: yields a temporary path that replaces ``path`` on success.

    Raises:
        DataError: If the file cannot be written.
    """
    # Processes on several machines, with equal process numbers, may write to the same folder.
    temporary = path.with_name(f".{path.name}.{uuid4().hex[:12]}.tmp{path.suffix}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            yield temporary
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)
    except OSError as error:
        raise DataError(f"cannot be written: {error.strerror or error}", place=str(path)) from None


@contextmanager
def creating_folder(folder: Path, otherwise: str) -> Iterator[Path]:
    """Context manager: yields a temporary folder that becomes ``folder`` on success.

    Args:
        folder: The folder.
        otherwise: What to do if it exists already, besides removing it.

    Raises:
        DataError: If the folder exists, or cannot be written.
    """
    if folder.exists():
        raise DataError(f"the folder exists already; remove it, or {otherwise}", place=str(folder))
    temporary = folder.with_name(f".{folder.name}.tmp")
    try:
        shutil.rmtree(temporary, ignore_errors=True)  # What a killed process left.
        temporary.mkdir(parents=True)
        yield temporary
        temporary.rename(folder)
    except OSError as error:
        raise DataError(
            f"cannot be written: {error.strerror or error}", place=str(folder)
        ) from None
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


def remove_unfinished(folder: Path, name: str = "*") -> None:
    """Removes temporary files that ``replacing`` left behind when its process was killed."""
    for path in folder.glob(f".{name}.*.tmp*"):
        path.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> None:
    """Writes ``text`` as UTF-8, atomically."""
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def write_arrays(path: Path, arrays: Mapping[str, Array | np.ndarray[Any, Any]]) -> None:
    """Writes named arrays as a compressed ``.npz``, atomically."""
    with replacing(path) as temporary, temporary.open("wb") as stream:
        np.savez_compressed(stream, **dict(arrays))  # type: ignore[arg-type]
