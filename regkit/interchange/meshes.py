"""Import of skinned meshes in all supported formats."""

from __future__ import annotations

from pathlib import Path

from pydantic import RootModel

from regkit.config.document import Document
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interchange.gltf.file import SUFFIXES
from regkit.interchange.gltf.gltf import RiggedBody
from regkit.system.errors import ConfigError


class BoneParents(RootModel[dict[str, str | None]]):
    """The parent of each bone; null for the root."""


def read_mesh(path: Path, parents: Path | None = None) -> SkinnedMesh:
    """Reads the skinned mesh of an ``.npz``, ``.glb`` or ``.gltf`` file.

    Args:
        path: The file.
        parents: A YAML file with the parent of each bone, for a glTF whose bones are not a tree.

    Raises:
        RegkitError: If a file is missing or invalid.
    """
    gltf = path.suffix.lower() in SUFFIXES
    if not gltf and parents is not None:
        raise ConfigError(
            f"{path} names the bones' parents itself; leave {parents} out", place="parents"
        )
    if not gltf:
        return SkinnedMesh.read(path)
    named = None if parents is None else Document.read(parents).validated(BoneParents).root
    return RiggedBody.read(path, parents=named).mesh
