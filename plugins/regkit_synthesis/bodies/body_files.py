"""Reading of rigged bodies from files."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from regkit.geometry.mesh_file import mesh_arrays
from regkit.geometry.rigid import rigid
from regkit.geometry.skinned_mesh import KEYS, SHAPE_KEYS, SkinnedMesh
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError
from regkit.system.guard import reading

_EXPORT = {"skin_indices": "skin_i", "skin_weights": "skin_w"}
"""Names of two arrays in an export of anny."""


def read_npz_body(path: Path, shape: int) -> SkinnedMesh:
    """Reads a mesh file, or an export of anny, which has several shapes of one body.

    Args:
        path: An ``.npz`` file.
        shape: Index of the shape.

    Raises:
        ConfigError: If there is no such shape.
        DataError: If the file is missing or is not a mesh.
    """
    mesh = _export(path, shape)
    if mesh is None and shape:
        raise ConfigError(f"there is no shape {shape}; the file holds one, 0", place=str(path))
    return SkinnedMesh.read(path) if mesh is None else mesh


def _export(path: Path, shape: int) -> SkinnedMesh | None:
    """Returns a shape of an export of anny, or None if the file is not one."""
    try:
        named = mesh_arrays(path, [_EXPORT.get(key, key) for key in KEYS])
    except DataError:
        # Reading it as a mesh file reports what is wrong with the file.
        return None
    arrays = dict(zip(KEYS, named.values(), strict=True))
    count = len(arrays["rest_vertices"])
    if not 0 <= shape < count:
        raise ConfigError(
            f"there is no shape {shape}; the file holds {count}, from 0 on", place=str(path)
        )
    with reading(path, "an export of anny"):
        return SkinnedMesh.of(arrays | {key: arrays[key][shape] for key in SHAPE_KEYS}, path)


def turned_mesh(mesh: SkinnedMesh, rotation: Array) -> SkinnedMesh:
    """Returns the mesh and its bones rotated by ``rotation`` (3, 3) about the origin."""
    return replace(
        mesh,
        vertices=mesh.vertices @ rotation.T,
        rest=rigid(rotation, np.zeros(3)) @ mesh.rest,
    )
