"""Symbolic links in a folder of results, which may come from anyone."""

from __future__ import annotations

import os
from pathlib import Path

from regkit.system.errors import DataError


def check_links(folder: Path) -> None:
    """Refuses a folder in which a symbolic link leads out of it.

    Reading through such a link could show another's file, and writing replace it.

    Raises:
        DataError: At the first link that leaves the folder.
    """
    root = folder.resolve()
    for place, folders, files in os.walk(folder, followlinks=False):
        for name in (*folders, *files):
            path = Path(place, name)
            if path.is_symlink() and not _resolved(path).is_relative_to(root):
                raise DataError(
                    f"the symbolic link leads out of {folder}; replace it by what it leads to",
                    place=str(path),
                )


def _resolved(path: Path) -> Path:
    try:
        return path.resolve()
    except (OSError, RuntimeError):  # A loop of links leads nowhere.
        return Path(path.anchor)
