"""Reading point clouds from files of points or meshes."""

from __future__ import annotations

import re
import zlib
from collections.abc import Callable
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np

from regkit.system.arrays import Array, checked_points
from regkit.system.errors import DataError
from regkit.system.optional import load_library

TEXT = (".txt", ".csv", ".xyz")
"""Text files with rows that begin with x y z; further columns are ignored."""

CLOUDS = (".ply", ".pcd", ".pts", ".xyzn", ".xyzrgb")
"""Point cloud formats that Open3D reads; a .ply may contain a mesh."""

MESHES = (".stl", ".obj", ".off", ".gltf", ".glb")
"""Mesh formats that Open3D reads."""

READABLE = (".npz", *TEXT, *CLOUDS, *MESHES)
"""All suffixes that ``read_cloud`` accepts."""

MESH_SAMPLES = 20_000
"""Number of points sampled from the surface of a mesh."""

DAMAGED = "the file contains no points or is damaged"

_READ_ERRORS = (OSError, EOFError, ValueError, KeyError, TypeError, BadZipFile, zlib.error)


def read_cloud(path: Path) -> Array:
    """Reads the points (N, 3) of a cloud, or samples them uniformly from the surface of a mesh.

    Raises:
        DataError: If the file is missing, damaged, empty or of an unknown format, or if a point is
            not finite.
        DependencyError: If the format needs Open3D, which is missing.
    """
    place = str(path)
    if not path.is_file():
        reason = "this is a folder, not a file" if path.is_dir() else "there is no such file"
        raise DataError(reason, place=place)
    suffix = path.suffix.lower()
    if suffix == ".npz":
        points = _archived(path)
    elif suffix in TEXT:
        points = _written(path)
    elif suffix in (*CLOUDS, *MESHES):
        points = _with_open3d(path, mesh=suffix in MESHES)
    else:
        raise DataError(
            f"files that end with '{suffix}' cannot be read; convert it to one of "
            f"{' '.join(READABLE)}",
            place=place,
        )
    checked = checked_points(points, place=place)
    if not len(checked):
        raise DataError(DAMAGED, place=place)
    return checked


def _archived(path: Path) -> Array:
    try:
        with path.open("rb") as stream, np.load(stream, allow_pickle=False) as arrays:
            return np.asarray(arrays["points"].astype(np.float64))
    except _READ_ERRORS as error:
        raise DataError(
            f"not a .npz with an array 'points' (N, 3): {error}", place=str(path)
        ) from None


def _written(path: Path) -> Array:
    """Reads rows of numbers, separated by spaces, commas or semicolons; a header is skipped."""
    rows: list[list[float]] = []
    text = path.read_text(encoding="utf-8-sig", errors="replace")
    for number, line in enumerate(text.splitlines(), start=1):
        parts = line.replace(",", " ").replace(";", " ").split()
        if not parts or parts[0].startswith("#"):
            continue
        try:
            row = [float(part) for part in parts[:3]]
        except ValueError:
            row = []
        if len(row) == 3:
            rows.append(row)
        elif rows or number > 1:
            raise DataError(
                f"not a row that begins with x y z: {line.strip()[:60]!r}", place=f"{path}:{number}"
            )
    return np.array(rows).reshape(-1, 3)


def _with_open3d(path: Path, *, mesh: bool) -> Array:
    library = load_library("open3d")
    if not mesh and not (path.suffix.lower() == ".ply" and _has_faces(path)):
        cloud = _quietly(path, library.io.read_point_cloud)
        return np.asarray(cloud.points)
    read = _quietly(path, library.io.read_triangle_mesh)
    vertices, triangles = np.asarray(read.vertices), np.asarray(read.triangles)
    if not len(triangles):
        return vertices
    return _sampled(checked_points(vertices, place=str(path)), triangles)


def _has_faces(path: Path) -> bool:
    """Returns whether the header of a PLY file declares triangles.

    Raises:
        DataError: If the file has no PLY header.
    """
    with path.open("rb") as stream:
        header, ended, _ = stream.read(1 << 16).partition(b"end_header")
    if not header.startswith(b"ply") or not ended:
        raise DataError(DAMAGED, place=str(path))
    counts = re.findall(rb"^element face (\d+)", header, flags=re.MULTILINE)
    return any(int(count) for count in counts)


def _quietly(path: Path, read: Callable[[str], Any]) -> Any:
    """Returns what Open3D reads.

    Open3D reports failures by printing only, and returns uninitialised memory for a truncated PLY.

    Raises:
        DataError: If Open3D printed anything.
    """
    library = load_library("open3d")
    level = library.utility.VerbosityLevel.Warning
    with library.utility.VerbosityContextManager(level), redirect_stdout(StringIO()) as printed:
        result = read(str(path))
    if printed.getvalue():
        raise DataError(DAMAGED, place=str(path))
    return result


def _sampled(vertices: Array, triangles: Array) -> Array:
    """Returns uniform samples (``MESH_SAMPLES``, 3) of a mesh, with a fixed seed."""
    corners = vertices[triangles]
    sides = corners[:, 1:] - corners[:, :1]
    areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    if not areas.sum() > 0.0:
        return vertices
    random = np.random.default_rng(0)
    chosen = random.choice(len(areas), size=MESH_SAMPLES, p=areas / areas.sum())
    first, second = random.uniform(size=(2, MESH_SAMPLES, 1))
    # The square root makes the density uniform: Osada et al., Shape distributions, 2002, eq. 1.
    root = np.sqrt(first)
    a, b, c = corners[chosen].transpose(1, 0, 2)
    return np.asarray((1.0 - root) * a + root * (1.0 - second) * b + root * second * c)
