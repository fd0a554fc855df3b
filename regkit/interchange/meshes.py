"""Import of skinned meshes in all supported formats."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from pydantic import RootModel

from regkit.body.modes import Modes
from regkit.config.document import Document
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interchange.body_model.model_file import SUFFIXES
from regkit.interchange.body_model.smpl import MODES, REQUIRED, BodyModel
from regkit.interchange.gltf.file import SUFFIXES as GLTF
from regkit.interchange.gltf.gltf import RiggedBody
from regkit.system.archives import array_names
from regkit.system.errors import ConfigError


class BoneParents(RootModel[dict[str, str | None]]):
    """The parent of each bone; null for the root."""


def read_mesh(path: Path, parents: Path | None = None) -> SkinnedMesh:
    """Reads the skinned mesh of an ``.npz``, ``.glb`` or ``.gltf`` file, or of a body model.

    Args:
        path: The file.
        parents: A YAML file with the parent of each bone, for a glTF whose bones are not a tree.

    Raises:
        RegkitError: If a file is missing or invalid.
    """
    return read_shaped_mesh(path, parents)[0]


def read_shaped_mesh(
    path: Path, parents: Path | None = None, modes: int = MODES
) -> tuple[SkinnedMesh, Modes | None]:
    """Reads a skinned mesh and its shape modes, which only a body model has.

    Args:
        path: The file.
        parents: A YAML file with the parent of each bone, for a glTF whose bones are not a tree.
        modes: Number of shape modes to take.

    Raises:
        RegkitError: If a file is missing or invalid.
    """
    gltf = path.suffix.lower() in GLTF
    if not gltf and parents is not None:
        raise ConfigError(
            f"{path} names the bones' parents itself; leave {parents} out", place="parents"
        )
    if _is_body_model(path):
        model = BodyModel.read(path, np.eye(3), modes=modes)
        return model.mesh, model.modes
    if not gltf:
        return SkinnedMesh.read(path), None
    named = None if parents is None else Document.read(parents).validated(BoneParents).root
    return RiggedBody.read(path, parents=named).mesh, None


def _is_body_model(path: Path) -> bool:
    """Returns whether a file is a pickle, or an archive with the arrays of a body model."""
    suffix = path.suffix.lower()
    if suffix == ".npz":
        return path.is_file() and REQUIRED[0] in array_names(path, "a skinned mesh")
    return suffix in SUFFIXES
