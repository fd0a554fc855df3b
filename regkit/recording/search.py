"""The folders of recordings in a folder."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from regkit.recording.cameras import FILE as CAMERAS
from regkit.system.errors import DataError, RegkitError

R = TypeVar("R")


def recording_folders(root: Path, content: str, *, several: bool = False) -> list[Path]:
    """Returns ``root`` if it is a recording, or the recordings in it, with a folder ``content``.

    Args:
        root: The folder.
        content: Name of the folder within a recording that holds the frames.
        several: Whether a recording may have several cameras.

    Raises:
        DataError: If there is none.
    """
    if root.is_file():
        raise DataError(
            "this is a file; a dataset reads the folder of a recording", place=str(root)
        )
    if not root.is_dir():
        raise DataError("there is no such folder", place=str(root))
    if (root / CAMERAS).is_file():
        if several:
            return [root]
        raise DataError(
            "this is a recording of several cameras, which the dataset kind 'depth' reads, with "
            "their images or clouds",
            place=str(root),
        )
    if (root / content).is_dir():
        return [root]
    found = {folder.parent for folder in root.glob(f"*/{content}") if folder.is_dir()}
    if several:
        found |= {file.parent for file in root.glob(f"*/{CAMERAS}") if file.is_file()}
    folders = sorted(found)
    if not folders:
        raise DataError(
            f"no recording here: neither this folder nor one in it contains '{content}/' "
            "beside a sequence.yaml; a recording has either depth/ or clouds/",
            place=str(root),
        )
    return folders


def recordings_in(
    root: Path,
    content: str,
    read: Callable[[Path], R],
    wanted: Callable[[str], bool],
    *,
    several: bool = False,
) -> list[R]:
    """Returns the result of ``read`` for each folder; damaged ones matter only if requested.

    The arguments are those of ``recording_folders``.

    Raises:
        DataError: If there is none, or a requested one is damaged.
    """
    found = []
    for folder in recording_folders(root, content, several=several):
        try:
            found.append(read(folder))
        except RegkitError:
            if wanted(folder.name):
                raise
    return found
