"""Writing triangle meshes to files."""

from __future__ import annotations

from pathlib import Path

from regkit.system.arrays import Array, Indices
from regkit.system.errors import ConfigError
from regkit.system.files import replacing
from regkit.system.optional import load_library

SUFFIXES = (".ply", ".obj", ".glb", ".stl")
"""Suffixes of the formats."""


def check_mesh_writable(path: Path, *, place: str) -> None:
    """Rejects a file name whose format ``write_mesh`` does not know, before any computation.

    Args:
        path: The file to be written.
        place: The argument or option that names it, for the error message.

    Raises:
        ConfigError: If the suffix is unknown.
    """
    if path.suffix.lower() not in SUFFIXES:
        raise ConfigError(
            f"the name must end with one of {' '.join(SUFFIXES)}; '{path.name}' does not",
            place=place,
        )


def write_mesh(path: Path, vertices: Array, faces: Indices) -> None:
    """Writes a mesh in the format of the file's suffix, with its vertices in their order.

    An ``.stl`` has no common vertices, so that their order is lost in it.

    Args:
        path: The file.
        vertices: Vertices, (V, 3) [m].
        faces: Vertex indices of the triangles, (F, 3).

    Raises:
        ConfigError: If the suffix is unknown.
        DataError: If the file cannot be written.
        DependencyError: If trimesh is missing.
    """
    check_mesh_writable(path, place=str(path))
    mesh = load_library("trimesh").Trimesh(vertices, faces, process=False)
    kind = path.suffix.lower().removeprefix(".")
    with replacing(path) as temporary:
        mesh.export(str(temporary), file_type=kind)
