"""Writing point clouds to files."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError
from regkit.system.files import replacing, write_arrays
from regkit.system.notes import note
from regkit.system.optional import load_library

TEXT = {".txt": " ", ".xyz": " ", ".csv": ","}
"""Text formats and their delimiters."""

MAX_ROUNDING = 1e-5
"""Largest rounding, as a fraction of the cloud's extent, that is not worth a word."""

WITH_OPEN3D = (".ply", ".pcd")
"""Formats that Open3D writes."""


def check_writable(path: Path, *, place: str) -> None:
    """Rejects a file name whose format ``write_cloud`` does not know, before any computation.

    Args:
        path: The file to be written.
        place: The argument or option that names it, for the error message.

    Raises:
        ConfigError: If the suffix is unknown.
    """
    known = (*WITH_OPEN3D, ".npz", *TEXT)
    if path.suffix.lower() not in known:
        raise ConfigError(
            f"the name must end with one of {' '.join(known)}; '{path.name}' does not",
            place=place,
        )


def write_cloud(path: Path, points: Array) -> None:
    """Writes points (N, 3) [m] in the format of the file's suffix.

    Raises:
        DataError: If the file cannot be written.
        DependencyError: If the format needs Open3D, which is missing.
    """
    suffix = path.suffix.lower()
    if suffix == ".npz":
        write_arrays(path, {"points": points})
        return
    with replacing(path) as temporary:
        if suffix in TEXT:
            np.savetxt(temporary, points, fmt="%.17g", delimiter=TEXT[suffix])
            return
        if suffix == ".pcd":
            rounded = float(np.abs(points.astype(np.float32) - points).max())
            if rounded > MAX_ROUNDING * float(np.ptp(points, axis=0).max()):
                note(
                    f"a .pcd holds 32 bits per number, which moves points by up to {rounded:.2g}; "
                    "write .ply or .npz",
                    place=path,
                )
        library = load_library("open3d")
        cloud = library.geometry.PointCloud(library.utility.Vector3dVector(points))
        if not library.io.write_point_cloud(str(temporary), cloud):
            raise DataError(
                "Open3D cannot write this file; check that the folder is writable", place=str(path)
            )
