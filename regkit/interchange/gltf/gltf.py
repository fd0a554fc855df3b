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
from regkit.geometry.rigid import transformed
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interchange.bone_frames import along_bones, nearest_rotations
from regkit.interchange.gltf import webxr_hand
from regkit.interchange.gltf.clip import GltfClip
from regkit.interchange.gltf.file import GltfFile
from regkit.interchange.gltf.nodes import Nodes
from regkit.interchange.gltf.skin import skinned_vertices
from regkit.system.arrays import Array, read_only

UNEVEN = 1e-3
"""Largest relative difference between the scales of the axes of a uniform scale."""


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
        """Reads the only skin of a ``.glb`` or ``.gltf`` file, and all meshes skinned to it.

        Vertices that differ only in texture coordinates or normals are merged, which closes the
        surface at texture seams.

        Args:
            path: The file.
            parents: Parent of each bone, None for the root, if the nodes of the file are not a
                tree. For WebXR hands it is built in.

        Raises:
            DataError: If the file is missing or invalid, or does not have exactly one skin.
            DependencyError: If pygltflib is missing.
        """
        file = GltfFile.read(path)
        nodes = Nodes.of(file)
        skins = file.content.skins or []
        if len(skins) != 1:
            raise file.wrong(f"the file has {len(skins)} skins; it must have exactly one")
        joints = [int(joint) for joint in skins[0].joints]
        if not joints or not all(0 <= joint < len(nodes.names) for joint in joints):
            raise file.wrong(f"the skin's joints {joints[:20]} are not all nodes")
        if skins[0].inverseBindMatrices is None:
            binds = np.tile(np.eye(4), (len(joints), 1, 1))
        else:
            binds = file.floats(skins[0].inverseBindMatrices).reshape(-1, 4, 4).swapaxes(1, 2)
        if len(binds) != len(joints):
            raise file.wrong(f"the skin has {len(joints)} joints and {len(binds)} matrices")
        above = _parents(file, nodes, joints, parents)
        order = _parents_first(file, above)
        place = np.argsort(order)
        joints, binds = [joints[bone] for bone in order], binds[order]
        above = [int(place[above[bone]]) if above[bone] >= 0 else -1 for bone in order]
        # The transform of the vertices by the first bone in the scene.
        shown = nodes.placed(nodes.given)[joints[0]] @ binds[0]
        _check_even(file, shown)
        bound = shown @ np.linalg.inv(binds)
        rest = along_bones(bound[:, :3, 3], nearest_rotations(bound[:, :3, :3]), above)
        vertices = skinned_vertices(file, len(joints)).joined()
        mesh = SkinnedMesh(
            vertices=read_only(transformed(shown, vertices.positions)),
            faces=vertices.faces,
            labels=tuple(nodes.names[joint] for joint in joints),
            parents=np.array(above, dtype=np.intp),
            rest=read_only(rest),
            indices=place[vertices.bones],
            weights=read_only(vertices.weights),
        )
        # The pose of a bone is its node's motion of the bone frame at rest.
        frames = binds @ np.linalg.inv(shown) @ rest
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


def _check_even(file: GltfFile, transform: Array) -> None:
    """Rejects a transform with a non-uniform scale or a reflection.

    Raises:
        DataError: If the scale is not uniform, or the transform is a reflection.
    """
    sizes = np.linalg.svd(transform[:3, :3])[1]
    if sizes[2] < (1.0 - UNEVEN) * sizes[0] or sizes[0] == 0.0:
        raise file.wrong(
            f"the skeleton is scaled unevenly ({', '.join(f'{size:.4g}' for size in sizes)}); "
            "apply its scale to the mesh before the export"
        )
    if np.linalg.det(transform[:3, :3]) < 0.0:
        raise file.wrong("the skeleton is mirrored; apply its scale before the export")
