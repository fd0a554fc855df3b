"""Point clouds in folders."""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from contextlib import redirect_stdout
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from typing import Literal
from zipfile import BadZipFile

import numpy as np

from regkit.arrays import Array, checked_points
from regkit.errors import DataError
from regkit.interfaces import Dataset, Sequence
from regkit.model import InputPath
from regkit.observation import Frame, Truth
from regkit.optional import open3d
from regkit_plugins.datasets.folders import (
    SequenceDescription,
    numbered_files,
    read_truth,
    sequences_in,
)

SUFFIXES = (".ply", ".pcd", ".xyz", ".npz")

_DAMAGED = (BadZipFile, zlib.error)


class CloudFolders(Dataset):
    """One folder of point clouds, or a folder of such folders.

    A ``.npz`` holds the array ``points`` (N, 3) [m]; the other formats are read by Open3D.
    """

    kind: Literal["clouds"] = "clouds"

    root: InputPath
    """The sequence's folder, or one that holds several."""

    def found(self) -> list[Sequence]:
        """A sequence for each folder that has ``clouds/``."""
        return sequences_in(self.root, "clouds", self._sequence, self.wanted)

    def _sequence(self, folder: Path) -> CloudSequence:
        description = SequenceDescription.read(folder)
        files = numbered_files(folder / "clouds", SUFFIXES)[: self.frames]
        return CloudSequence(
            name=description.name or folder.name,
            fps=description.fps,
            length=len(files),
            folder=folder,
            files=tuple(files),
        )


@dataclass(frozen=True)
class CloudSequence(Sequence):
    """One folder of clouds.

    Attributes:
        folder: Where it lies.
        files: The clouds.
    """

    folder: Path
    files: tuple[Path, ...]

    def frames(self) -> Iterator[Frame]:
        """The clouds, in the camera's frame (x right, y down, z forward)."""
        for path in self.files:
            yield Frame(read_cloud(path), place=str(path))

    def truth(self) -> Truth | None:
        """The joints of ``truth.csv``."""
        return read_truth(self.folder / "truth.csv", self.length)


def read_cloud(path: Path) -> Array:
    """The points (N, 3) [m] of a file.

    Raises:
        DataError: If the file is missing or damaged, or a point is not finite.
        DependencyError: If Open3D is needed and missing.
    """
    if not path.is_file():
        raise DataError("there is no such file", place=str(path))
    if path.suffix.lower() == ".npz":
        try:
            with path.open("rb") as stream, np.load(stream, allow_pickle=False) as arrays:
                points = arrays["points"].astype(np.float64)
        except (OSError, EOFError, ValueError, KeyError, TypeError, *_DAMAGED) as error:
            raise DataError(
                f"not a .npz with an array 'points' (N, 3): {error}", place=str(path)
            ) from None
    else:
        library = open3d()
        level = library.utility.VerbosityLevel.Warning
        # Open3D only prints that it failed, and returns what was in the memory beyond a PLY's end.
        with library.utility.VerbosityContextManager(level), redirect_stdout(StringIO()) as told:
            points = np.asarray(library.io.read_point_cloud(str(path)).points)
        if told.getvalue():
            raise DataError("the file holds no point, or is damaged", place=str(path))
    checked = checked_points(points, place=str(path))
    if not len(checked):
        raise DataError("the file holds no point, or is damaged", place=str(path))
    return checked
