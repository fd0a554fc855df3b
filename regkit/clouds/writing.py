"""Writing clouds to files."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError
from regkit.system.files import replacing, write_arrays
from regkit.system.optional import load_library

TEXT = {".txt": " ", ".xyz": " ", ".csv": ","}
"""What parts the numbers of a row."""

WITH_OPEN3D = (".ply", ".pcd")


def check_writable(path: Path, *, place: str) -> None:
    """Refuse a name that ``write_cloud`` could not write, before any work is done.

    Raises:
        ConfigError: If it does not end with a known suffix.
    """
    known = (*WITH_OPEN3D, ".npz", *TEXT)
    if path.suffix.lower() not in known:
        raise ConfigError(f"the name must end with one of {' '.join(known)}", place=place)


def write_cloud(path: Path, points: Array) -> None:
    """Write points (N, 3) in the format that the file's name says.

    Raises:
        DataError: If the file cannot be written.
        DependencyError: If Open3D is needed and missing.
    """
    suffix = path.suffix.lower()
    if suffix == ".npz":
        write_arrays(path, {"points": points})
        return
    with replacing(path) as temporary:
        if suffix in TEXT:
            np.savetxt(temporary, points, fmt="%.17g", delimiter=TEXT[suffix])
            return
        library = load_library("open3d")
        cloud = library.geometry.PointCloud(library.utility.Vector3dVector(points))
        if not library.io.write_point_cloud(str(temporary), cloud):
            raise DataError("cannot be written", place=str(path))
