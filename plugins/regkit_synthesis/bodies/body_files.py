"""Reading of rigged bodies from files."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from regkit.geometry.rigid import rigid
from regkit.geometry.skinned_mesh import KEYS, SkinnedMesh
from regkit.system.archives import array_names, read_arrays
from regkit.system.arrays import Array, read_only
from regkit.system.errors import ConfigError

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
    # Reading it as a mesh file reports what is wrong with a missing file.
    if not path.is_file() or not {_EXPORT.get(key, key) for key in KEYS} <= set(array_names(path)):
        return None
    stored = read_arrays(path, [_EXPORT.get(key, key) for key in KEYS])
    arrays = dict(zip(KEYS, stored.values(), strict=True))
    count = len(arrays["rest_vertices"])
    if not 0 <= shape < count:
        raise ConfigError(
            f"there is no shape {shape}; the file holds {count}, from 0 on", place=str(path)
        )
    return SkinnedMesh(
        read_only(arrays["rest_vertices"][shape]),
        arrays["faces"].astype(np.intp),
        tuple(str(label) for label in arrays["labels"]),
        arrays["parents"].astype(np.intp),
        read_only(arrays["rest_bone_poses"][shape]),
        arrays["skin_indices"].astype(np.intp),
        read_only(arrays["skin_weights"]),
    )


def turned_mesh(mesh: SkinnedMesh, rotation: Array) -> SkinnedMesh:
    """Returns the mesh and its bones rotated by ``rotation`` (3, 3) about the origin."""
    return replace(
        mesh,
        vertices=mesh.vertices @ rotation.T,
        rest=rigid(rotation, np.zeros(3)) @ mesh.rest,
    )
