"""Reading point clouds from files of points or meshes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from regkit.clouds.formats.gltf import read_gltf
from regkit.clouds.formats.mesh import surface_points
from regkit.clouds.formats.obj import read_obj
from regkit.clouds.formats.off import read_off
from regkit.clouds.formats.pcd import read_organised_pcd, read_pcd
from regkit.clouds.formats.ply import read_organised_ply, read_ply
from regkit.clouds.formats.stl import read_stl
from regkit.clouds.formats.text import read_text
from regkit.clouds.organised import OrganisedCloud
from regkit.system.archives import read_arrays
from regkit.system.arrays import Array, Indices, measured_points, without_missing
from regkit.system.errors import DataError
from regkit.system.guard import reading

TEXT = (".txt", ".csv", ".tsv", ".asc", ".xyz", ".xyzn", ".xyzrgb", ".pts")
"""Text files of rows of numbers."""

MESHES: dict[str, Callable[[Path], tuple[Array, Indices]]] = {
    ".ply": read_ply,
    ".stl": read_stl,
    ".obj": read_obj,
    ".off": read_off,
    ".gltf": read_gltf,
    ".glb": read_gltf,
}
"""Readers of vertices (V, 3) and triangles (T, 3); without triangles the file is a cloud."""

ORGANISED: dict[str, Callable[[Path], OrganisedCloud | None]] = {
    ".pcd": read_organised_pcd,
    ".ply": read_organised_ply,
}
"""Readers of clouds in rows and columns; None of a file that has none."""

READABLE = (".npz", ".pcd", *TEXT, *MESHES)
"""All suffixes that ``read_cloud`` accepts."""


def read_cloud(path: Path) -> Array:
    """Reads the points (N, 3) of a cloud, or samples them uniformly from the surface of a mesh.

    Rows with NaN or infinity are missing measurements; they are dropped, and told.

    Raises:
        DataError: If the file is missing, damaged, empty, ambiguous or of an unknown format, or if
            all its points are missing measurements.
    """
    return without_missing(_stored(path), place=str(path))


def read_measured(path: Path) -> Array:
    """Reads a cloud like ``read_cloud``, for the frames of a sensor.

    Missing measurements are usual there: they are dropped without a word, and there may be no
    others, so that no point (0, 3) remains.

    Raises:
        DataError: If the file is missing, damaged, empty, ambiguous or of an unknown format.
    """
    return measured_points(_stored(path), place=str(path))


def read_organised(path: Path) -> OrganisedCloud | None:
    """Reads a cloud in rows and columns; returns None if the file's format says of none.

    Raises:
        DataError: If the file is damaged.
    """
    suffix = path.suffix.lower()
    if suffix not in ORGANISED or not path.is_file():
        return None
    with reading(path, f"a {suffix} file of points"), np.errstate(invalid="ignore"):
        return ORGANISED[suffix](path)


def _stored(path: Path) -> Array:
    """Returns all points (N, 3) of a file, missing measurements included."""
    suffix, place = path.suffix.lower(), str(path)
    if path.is_dir():
        raise DataError("this is a folder, not a file", place=place)
    if path.exists() and suffix not in READABLE:
        raise DataError(
            f"files that end with '{suffix}' cannot be read; convert it to one of "
            f"{' '.join(READABLE)}",
            place=place,
        )
    # Casting a signalling NaN would warn; it is a missing measurement like any other.
    with reading(path, f"a {suffix} file of points"), np.errstate(invalid="ignore"):
        if suffix == ".npz":
            points = _archived(path)
        elif suffix == ".pcd":
            points = read_pcd(path)
        elif suffix in MESHES:
            points = surface_points(*MESHES[suffix](path), place=place)
        else:
            points = read_text(path)
    if not len(points):
        raise DataError("the file contains no points", place=place)
    return points


def _archived(path: Path) -> Array:
    what = "a .npz with an array 'points' (N, 3)"
    stored = read_arrays(path, ["points"], what)["points"]
    if stored.dtype.kind not in "fiu" or stored.ndim != 2 or stored.shape[1] != 3:
        raise DataError(f"not {what}: it is {stored.dtype} of the shape {stored.shape}")
    return stored.astype("f8")
