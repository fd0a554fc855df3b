"""Import of rigged bodies from glTF files.

glTF has the axes of regkit's bodies: metres, y up, z to the front, x to the body's left. The rest
pose of the mesh is the bind pose of the skin's inverse bind matrices, placed in the scene by the
skin's first bone. In most files the scene shows the bind pose, and both are the same.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from regkit.config.model import did_you_mean
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interchange.bone_frames import along_bones, nearest_rotations
from regkit.interchange.gltf import webxr_hand
from regkit.interchange.gltf.bind import BindPose
from regkit.interchange.gltf.clip import GltfClip
from regkit.interchange.gltf.file import GltfFile
from regkit.interchange.gltf.nodes import Nodes
from regkit.interchange.gltf.skin import skinned_vertices
from regkit.system.arrays import read_only
from regkit.system.guard import reading


@dataclass(frozen=True)
class RiggedBody:
    """A skinned mesh and its motions.

    Attributes:
        mesh: The mesh; y points along its bones, whatever the convention of the rig.
        clips: The animations of the file, as poses of these bones.
    """

    mesh: SkinnedMesh
    clips: tuple[GltfClip, ...]

    @classmethod
    def read(cls, path: Path, *, parents: Mapping[str, str | None] | None = None) -> RiggedBody:
        """Reads the skeleton of a ``.glb`` or ``.gltf`` file, and all meshes skinned to it.

        Meshes may have skins of their own, if the skins have one bind pose. Vertices that differ
        only in texture coordinates or normals are merged, which closes the surface at texture
        seams. What is left out is told.

        Args:
            path: The file.
            parents: Parent of each bone, None for the root, if the nodes of the file are not a
                tree. For WebXR hands it is built in.

        Raises:
            DataError: If the file is missing or invalid, or has no skinned mesh.
            DependencyError: If pygltflib is missing.
        """
        with reading(path, "a glTF 2.0 file"):
            return cls._of(GltfFile.read(path), parents)

    @classmethod
    def _of(cls, file: GltfFile, parents: Mapping[str, str | None] | None) -> RiggedBody:
        nodes = Nodes.of(file)
        pose = BindPose.of(file, nodes)
        above = _parents(file, nodes, list(pose.joints), parents)
        order = _parents_first(file, above)
        place = np.argsort(order)
        joints, bound = [pose.joints[bone] for bone in order], pose.bound[order]
        above = [int(place[above[bone]]) if above[bone] >= 0 else -1 for bone in order]
        rest = along_bones(bound[:, :3, 3], nearest_rotations(bound[:, :3, :3]), above)
        vertices = skinned_vertices(file, pose).joined()
        mesh = SkinnedMesh(
            vertices=read_only(vertices.positions),
            faces=vertices.faces,
            labels=tuple(nodes.names[joint] for joint in joints),
            parents=np.array(above, dtype=np.intp),
            rest=read_only(rest),
            indices=place[vertices.bones],
            weights=read_only(vertices.weights),
        )
        # The pose of a bone is its node's motion of the bone frame at rest.
        frames = np.linalg.inv(bound) @ rest
        return cls(mesh, GltfClip.all_of(file, nodes, joints, frames))


def _parents(
    file: GltfFile, nodes: Nodes, joints: list[int], named: Mapping[str, str | None] | None
) -> list[int]:
    """Returns the index of each bone's parent: the nearest ancestor bone, or the named one.

    Raises:
        DataError: If the bones are not a tree, or a name is unknown.
    """
    names = [nodes.names[joint] for joint in joints]
    if named is None and set(names) == set(webxr_hand.PARENTS):
        named = webxr_hand.PARENTS
    if named is None:
        above = [nodes.nearest(joint, frozenset(joints)) for joint in joints]
        parents = [joints.index(node) if node >= 0 else -1 for node in above]
    else:
        for name in (*named, *filter(None, named.values())):
            if name not in names:
                raise file.wrong(
                    f"there is no bone '{name}' (there are: {', '.join(names)})"
                    + did_you_mean(name, names)
                )
        missing = [name for name in names if name not in named]
        if missing:
            raise file.wrong(f"the bones {', '.join(missing)} have no parent; name one for each")
        above_names = [named[name] for name in names]
        parents = [-1 if name is None else names.index(name) for name in above_names]
    roots = [name for name, parent in zip(names, parents, strict=True) if parent < 0]
    if len(roots) != 1:
        named_roots = f" ({', '.join(roots)})" if roots else ""
        raise file.wrong(
            f"{len(roots)} bones have no parent{named_roots}; exactly one must have none, name the "
            "parents of all others"
        )
    return parents


def _parents_first(file: GltfFile, parents: list[int]) -> list[int]:
    ordered = [parents.index(-1)]
    for bone in ordered:
        ordered += [child for child, parent in enumerate(parents) if parent == bone]
    if len(ordered) < len(parents):
        raise file.wrong("the parents of the bones form a cycle; they must form a tree")
    return ordered
