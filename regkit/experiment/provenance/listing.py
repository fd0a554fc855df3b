"""Files in folders, by names that do not depend on where the folders are."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from regkit.system.errors import DataError

RESULTS = {"config.yaml", "environment.json"}
"""Files by which a results folder is known: results may lie beside data, and are none."""


def files_by_name(paths: Iterable[Path]) -> dict[str, str]:
    """Returns the paths of files by their names relative to the folder that holds them all.

    A folder stands for all files in it, but for hidden ones and results. Paths that do not exist
    are left out.

    Raises:
        DataError: If a folder cannot be read.
    """
    files = sorted({file for path in paths for file in _files(str(path.absolute()))})
    if not files:
        return {}
    try:
        shared = os.path.commonpath([os.path.dirname(file) for file in files])  # noqa: PTH120
    except ValueError:  # Windows has several drives.
        return {file.replace(os.sep, "/"): file for file in files}
    start = len(shared.rstrip(os.sep)) + 1
    return {file[start:].replace(os.sep, "/"): file for file in files}


def _files(path: str) -> Iterator[str]:
    if os.path.isfile(path):  # noqa: PTH113 - text is much faster for many thousand files.
        yield path
        return
    seen: set[str] = set()
    for folder, inner, names in os.walk(path, onerror=_refuse, followlinks=True):
        real = os.path.realpath(folder)
        if set(names) >= RESULTS or real in seen:
            inner.clear()
            continue
        seen.add(real)  # Links may lead in circles.
        inner[:] = [name for name in inner if not name.startswith((".", "__pycache__"))]
        yield from (f"{folder}{os.sep}{name}" for name in names if not name.startswith("."))


def _refuse(error: OSError) -> None:
    if not isinstance(error, FileNotFoundError):
        raise DataError(f"cannot be read: {error.strerror or error}", place=error.filename)
