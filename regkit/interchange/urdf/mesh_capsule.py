"""Capsules in the place of meshes."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np

from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.guard import reading
from regkit.system.optional import load_library

LARGEST = 64_000_000
"""Size of the largest mesh file that is read [bytes]."""

ELONGATED = 1.5
"""A surface whose largest variance is below this multiple of the next one has no long axis."""


def read_triangles(path: Path) -> Array:
    """Returns the corners of a mesh's triangles, (F, 3, 3) [m].

    STL, OBJ, COLLADA, PLY and glTF files are read; textures are not. The unit of a COLLADA file is
    applied, and its up axis is not, as in RViz.

    Args:
        path: The file.

    Raises:
        DataError: If the file is missing or too large, or holds no triangles.
        DependencyError: If trimesh or pycollada is missing.
    """
    trimesh = load_library("trimesh")
    kind = path.suffix.lower().removeprefix(".")
    if kind == "dae":
        load_library("collada", install="pip install pycollada")
    with reading(path, "a mesh"):
        if path.stat().st_size > LARGEST:
            raise DataError(f"is larger than {LARGEST / 1e6:g} MB")
        content = io.BytesIO(path.read_bytes())
        scene = trimesh.load_scene(content, file_type=kind, process=False, skip_materials=True)
        parts = [np.zeros((0, 3, 3))]
        for node in scene.graph.nodes_geometry:
            transform, name = scene.graph[node]
            mesh = scene.geometry[name]
            unit = mesh.units
            scale = trimesh.units.unit_conversion(unit, "meters") if unit and kind == "dae" else 1.0
            corners = np.asarray(mesh.triangles, dtype=np.float64)
            parts.append(scale * (corners @ transform[:3, :3].T + transform[:3, 3]))
        triangles = np.concatenate(parts)
        if not len(triangles) or not np.isfinite(triangles).all():
            raise DataError("holds no triangles, or infinite numbers")
    return triangles


def mesh_capsule(triangles: Array) -> tuple[Array, Array, float]:
    """Returns the capsule of a surface: its ends (3,) and its radius [m].

    It lies along the surface's principal axis and is as long as the surface there. Its radius is
    the root mean square of the surface's distances from the axis, which is exact for a cylinder.
    A surface without a long axis, such as a disc's, becomes a sphere.

    Args:
        triangles: Corners of the triangles, (F, 3, 3) [m].
    """
    edges = triangles[:, 1:] - triangles[:, :1]
    areas = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
    # The midpoints of a triangle's edges integrate quadratic functions over it exactly.
    points = 0.5 * (triangles + np.roll(triangles, 1, axis=1)).reshape(-1, 3)
    weights = np.repeat(areas if areas.any() else np.ones_like(areas), 3)
    weights /= weights.sum()
    centre = weights @ points
    away = points - centre
    variances, axes = np.linalg.eigh(away.T @ (weights[:, None] * away))
    axis = axes[:, 2]
    along = (triangles.reshape(-1, 3) - centre) @ axis
    radius = float(np.sqrt(max(variances[0] + variances[1], 0.0)))
    low, high = float(along.min()) + radius, float(along.max()) - radius
    if high <= low or variances[2] < ELONGATED * variances[1]:
        return centre, centre, float(np.sqrt(max(variances.sum(), 0.0)))
    return centre + low * axis, centre + high * axis, radius
