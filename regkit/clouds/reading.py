"""Reading clouds, and points on the surfaces of meshes, from files."""

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
"""Files of numbers in rows, x y z first; what follows on a row is left out."""

CLOUDS = (".ply", ".pcd", ".pts", ".xyzn", ".xyzrgb")
"""Files of points that Open3D reads; a .ply may hold a mesh."""

MESHES = (".stl", ".obj", ".off", ".gltf", ".glb")
"""Files of triangles that Open3D reads."""

READABLE = (".npz", *TEXT, *CLOUDS, *MESHES)

ON_MESH = 20_000
"""So many points stand for the surface of a mesh."""

_DAMAGED = (OSError, EOFError, ValueError, KeyError, TypeError, BadZipFile, zlib.error)


def read_cloud(path: Path) -> Array:
    """The points (N, 3) of a cloud's file, or points spread evenly over a mesh's surface.

    Raises:
        DataError: If the file is missing, damaged, empty or of a kind that cannot be read, or if a
            point is not finite.
        DependencyError: If Open3D is needed and missing.
    """
    place = str(path)
    if not path.is_file():
        told = "this is a folder, not a file" if path.is_dir() else "there is no such file"
        raise DataError(told, place=place)
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
        raise DataError("the file holds no point, or is damaged", place=place)
    return checked


def _archived(path: Path) -> Array:
    try:
        with path.open("rb") as stream, np.load(stream, allow_pickle=False) as arrays:
            return np.asarray(arrays["points"].astype(np.float64))
    except _DAMAGED as error:
        raise DataError(
            f"not a .npz with an array 'points' (N, 3): {error}", place=str(path)
        ) from None


def _written(path: Path) -> Array:
    """Rows of numbers, parted by spaces or commas; a first row of names is left out."""
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
    return _on_surface(checked_points(vertices, place=str(path)), triangles)


def _has_faces(path: Path) -> bool:
    """Whether a PLY file holds triangles, as its header says.

    Raises:
        DataError: If it has no such header.
    """
    with path.open("rb") as stream:
        header, ended, _ = stream.read(1 << 16).partition(b"end_header")
    if not header.startswith(b"ply") or not ended:
        raise DataError("the file holds no point, or is damaged", place=str(path))
    counts = re.findall(rb"^element face (\d+)", header, flags=re.MULTILINE)
    return any(int(count) for count in counts)


def _quietly(path: Path, read: Callable[[str], Any]) -> Any:
    """What Open3D reads.

    It only prints that it failed, and returns what was in the memory beyond a PLY's end.

    Raises:
        DataError: If it printed anything.
    """
    library = load_library("open3d")
    level = library.utility.VerbosityLevel.Warning
    with library.utility.VerbosityContextManager(level), redirect_stdout(StringIO()) as told:
        result = read(str(path))
    if told.getvalue():
        raise DataError("the file holds no point, or is damaged", place=str(path))
    return result


def _on_surface(vertices: Array, triangles: Array) -> Array:
    """Points (``ON_MESH``, 3) spread evenly over triangles, the same ones at each call."""
    corners = vertices[triangles]
    sides = corners[:, 1:] - corners[:, :1]
    areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    if not areas.sum() > 0.0:
        return vertices
    random = np.random.default_rng(0)
    chosen = random.choice(len(areas), size=ON_MESH, p=areas / areas.sum())
    first, second = random.uniform(size=(2, ON_MESH, 1))
    # The square root spreads them evenly: Osada et al., Shape distributions, 2002, eq. 1.
    root = np.sqrt(first)
    a, b, c = corners[chosen].transpose(1, 0, 2)
    return np.asarray((1.0 - root) * a + root * (1.0 - second) * b + root * second * c)
