"""Files that are either there as a whole or not there at all."""

from __future__ import annotations

import json
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
    """A temporary name beside ``path`` to write to, renamed to ``path`` when all went well.

    Raises:
        DataError: If the file cannot be written.
    """
    # Processes of several machines may write to one folder, where their numbers may be the same.
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


def remove_unfinished(folder: Path, name: str = "*") -> None:
    """Remove what ``replacing`` left of a file, or of all, when its process was killed."""
    for path in folder.glob(f".{name}.*.tmp*"):
        path.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> None:
    """Write ``text`` as UTF-8."""
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def write_json(path: Path, data: Any) -> None:
    """Write ``data`` as indented JSON; a NaN has no place in it and must be given as None."""
    write_text(path, json.dumps(data, indent=2, allow_nan=False) + "\n")


def write_arrays(path: Path, arrays: Mapping[str, Array | np.ndarray[Any, Any]]) -> None:
    """Write named arrays as a compressed ``.npz``."""
    with replacing(path) as temporary, temporary.open("wb") as stream:
        np.savez_compressed(stream, **dict(arrays))  # type: ignore[arg-type]
