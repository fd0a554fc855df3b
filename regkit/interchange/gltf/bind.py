"""The bind pose of a glTF file's skins.

Source: The Khronos Group, glTF 2.0 Specification, section 3.7.3 (skins).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from regkit.interchange.gltf.file import GltfFile
from regkit.interchange.gltf.nodes import Nodes
from regkit.system.arrays import Array
from regkit.system.notes import note

UNEVEN = 1e-3
"""Largest relative difference between the scales of the axes of a uniform scale."""

APART = 1e-2
"""Largest distance between the positions of a joint in two skins, relative to the skeleton."""


@dataclass(frozen=True)
class BindPose:
    """The bind pose that the skins of a file have in common.

    Attributes:
        joints: Nodes of the joints of all skins, each once.
        bound: ``T_scene_joint`` in the bind pose, (J, 4, 4).
        members: For each skin that a mesh uses, the index of each of its joints in ``joints``.
        shown: For each skin that a mesh uses, the transform (4, 4) of its vertices into the scene.
    """

    joints: tuple[int, ...]
    bound: Array
    members: dict[int, list[int]]
    shown: dict[int, Array]

    @classmethod
    def of(cls, file: GltfFile, nodes: Nodes) -> BindPose:
        """Returns the bind pose of the skins that meshes use; others are left out with a note.

        A skin is placed by a joint that it shares with a larger one, or else by its first joint in
        the scene.

        Raises:
            DataError: If no mesh uses a skin, or one is invalid or in another pose than the rest.
        """
        skins = file.content.skins or []
        used = sorted({_skin(file, node) for node in file.content.nodes} - {-1})
        if not used:
            raise file.wrong(
                f"no mesh uses one of the {len(skins)} skins; the file needs a skinned mesh"
            )
        if len(used) < len(skins):
            note(f"skins that no mesh uses are left out: {len(skins) - len(used)}", place=file.path)
        read = {skin: _joints_and_binds(file, nodes, skins[skin]) for skin in used}
        scene = nodes.placed(nodes.given)
        place_of: dict[int, int] = {}
        bound: list[Array] = []
        members, shown = {}, {}
        for skin in sorted(used, key=lambda skin: -len(read[skin][0])):
            joints, binds = read[skin]
            shared = [k for k, joint in enumerate(joints) if joint in place_of]
            anchor = shared[0] if shared else 0
            placed = bound[place_of[joints[anchor]]] if shared else scene[joints[anchor]]
            shown[skin] = placed @ binds[anchor]
            _check_even(file, shown[skin])
            own = shown[skin] @ np.linalg.inv(binds)
            _check_same(file, skin, own[shared], [bound[place_of[joints[k]]] for k in shared])
            for joint, pose in zip(joints, own, strict=True):
                if joint not in place_of:
                    place_of[joint] = len(bound)
                    bound.append(pose)
            members[skin] = [place_of[joint] for joint in joints]
        return cls(tuple(place_of), np.array(bound), members, shown)


def _skin(file: GltfFile, node: Any) -> int:
    """Returns the index of the skin that a node's mesh uses, or -1."""
    if node.skin is None or node.mesh is None:
        return -1
    file.item(file.content.skins, node.skin, "skin")
    return int(node.skin)


def _joints_and_binds(file: GltfFile, nodes: Nodes, skin: Any) -> tuple[list[int], Array]:
    """Returns the nodes of a skin's joints, and their inverse bind matrices (J, 4, 4)."""
    joints = [joint for joint in skin.joints or () if isinstance(joint, int)]
    if not joints or not all(0 <= joint < len(nodes.names) for joint in joints):
        raise file.wrong(f"the skin's joints {(skin.joints or [])[:20]} are not all nodes")
    if skin.inverseBindMatrices is None:
        return joints, np.tile(np.eye(4), (len(joints), 1, 1))
    values = file.floats(skin.inverseBindMatrices)
    if values.shape[1] != 16 or len(values) < len(joints) or len(set(joints)) < len(joints):
        raise file.wrong(
            f"a skin has {len(joints)} joints and {len(values)} matrices of {values.shape[1]} "
            "numbers; each joint must occur once and needs one matrix of 16"
        )
    binds = values[: len(joints)].reshape(-1, 4, 4).swapaxes(1, 2)
    singular = np.abs(np.linalg.det(binds)) < 1e-12
    if singular.any():
        name = nodes.names[joints[int(np.argmax(singular))]]
        raise file.wrong(f"the inverse bind matrix of '{name}' has no inverse")
    return joints, binds


def _check_same(file: GltfFile, skin: int, own: Array, others: list[Array]) -> None:
    """Checks that a skin's joints are where other skins have them."""
    if not others:
        return
    known = np.array(others)[:, :3, 3]
    apart = float(np.linalg.norm(own[:, :3, 3] - known, axis=1).max())
    if apart > APART * max(float(np.ptp(known, axis=0).max()), 1e-9):
        raise file.wrong(
            f"skin {skin} binds a joint {apart:.3g} m from where another skin has it; apply the "
            "bind pose to all meshes before the export"
        )


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
