"""Reading of markers, whatever their format."""

from __future__ import annotations

from pathlib import Path

from regkit.recording.markers.c3d import read_c3d
from regkit.recording.markers.trajectories import Trajectories
from regkit.recording.markers.trc import read_trc
from regkit.system.errors import DataError
from regkit.system.guard import reading

READERS = {".trc": read_trc, ".c3d": read_c3d}
"""Reader of each suffix."""


def read_trajectories(path: Path) -> Trajectories:
    """Returns the markers of a ``.trc`` or ``.c3d`` file.

    Raises:
        DependencyError: If a C3D file is read, and ezc3d is not installed.
        DataError: If the file is missing, of another format, or damaged.
    """
    with reading(path, "a file of markers"):
        reader = READERS.get(path.suffix.lower())
        if reader is None:
            raise DataError(f"files of markers are {' or '.join(READERS)}")
        return reader(path)
