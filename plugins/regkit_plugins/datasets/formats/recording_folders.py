"""The folder format of recordings, common to depth images and clouds.

my_recording/
sequence.yaml      name, fps, depth_scale, source, licence
camera.json        intrinsics (depth images)
depth/000000.png   or clouds/000000.ply; numbered without gaps
truth.csv          optional: frame,joint,x,y,z [m] in the camera's frame
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

from pydantic import Field

from regkit.config.document import Document
from regkit.config.model import Model
from regkit.config.quantities import Rate
from regkit.interfaces import Recording
from regkit.system.errors import DataError, RegkitError

Positive = Annotated[float, Field(ge=1e-3, le=1e6)]


class RecordingDescription(Model):
    """The content of ``sequence.yaml``."""

    name: Annotated[str, Field(pattern=r"^\w[\w. -]*$")] | None = None
    """Name of the recording; by default that of its folder."""
    fps: Rate = 30.0
    """Frames per second."""
    depth_scale: Positive = 1000.0
    """Depth image units per metre: 1000 for millimetres."""
    source: str = ""
    """Origin of the data."""
    licence: str = ""
    """Licence of the data."""

    @classmethod
    def read(cls, folder: Path) -> RecordingDescription:
        """Returns the description of a recording's folder."""
        return Document.read(folder / "sequence.yaml").validated(cls)


def recording_folders(root: Path, content: str) -> list[Path]:
    """Returns ``root`` if it is a recording, or the recordings in it, with a folder ``content``.

    Raises:
        DataError: If there is none.
    """
    if root.is_file():
        raise DataError(
            "this is a file; a dataset reads the folder of a recording", place=str(root)
        )
    if not root.is_dir():
        raise DataError("there is no such folder", place=str(root))
    if (root / content).is_dir():
        return [root]
    folders = sorted(folder.parent for folder in root.glob(f"*/{content}") if folder.is_dir())
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
    read: Callable[[Path], Recording],
    wanted: Callable[[str], bool],
) -> list[Recording]:
    """Returns the result of ``read`` for each folder; damaged ones matter only if requested.

    Raises:
        DataError: If there is none, or a requested one is damaged.
    """
    found = []
    for folder in recording_folders(root, content):
        try:
            found.append(read(folder))
        except RegkitError:
            if wanted(folder.name):
                raise
    return found


def numbered_files(folder: Path, suffixes: tuple[str, ...]) -> list[Path]:
    """Returns the files 000000, 000001, ... of a folder.

    Raises:
        DataError: If there is none, or a number is missing.
    """
    files = sorted(path for path in folder.iterdir() if path.suffix.lower() in suffixes)
    if not files:
        raise DataError(f"the folder holds no {' or '.join(suffixes)} file", place=str(folder))
    for number, path in enumerate(files):
        if path.stem != f"{number:06d}":
            raise DataError(
                f"files must be numbered from 000000 without gaps; {number:06d} is missing before "
                f"{path.name}",
                place=str(folder),
            )
    return files


def existing(folder: Path, *names: str) -> list[Path]:
    """Returns those of the named files that the folder holds."""
    return [folder / name for name in names if (folder / name).is_file()]
