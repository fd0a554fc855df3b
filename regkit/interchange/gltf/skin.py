"""The skinned vertices of a glTF file."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from regkit.clouds.formats.gltf import LINES, POINTS, triangles
from regkit.geometry.mesh_file import FARTHEST
from regkit.geometry.rigid import transformed
from regkit.interchange.gltf.bind import BindPose
from regkit.interchange.gltf.file import GltfFile
from regkit.system.arrays import Array, Indices
from regkit.system.notes import note

ROUNDED = 0.03
"""Weights whose sum is further from one are more than rounded to eight bits."""


@dataclass(frozen=True)
class SkinnedVertices:
    """V vertices, each skinned to up to A bones, and F triangles.

    Attributes:
        positions: Positions in the bind pose, (V, 3) [m].
        bones: Indices of the joints, (V, A).
        weights: Skinning weights, (V, A); the rows sum to one.
        faces: Vertex indices of the triangles, (F, 3).
    """

    positions: Array
    bones: Indices
    weights: Array
    faces: Indices

    def joined(self) -> SkinnedVertices:
        """Returns the surface with vertices of equal position and weights merged."""
        # Rounding, because weights have various precisions.
        rows = np.concatenate([self.positions, self.bones, self.weights.round(5)], axis=1)
        _, first, number = np.unique(rows, axis=0, return_index=True, return_inverse=True)
        kept = np.sort(first)
        place = np.searchsorted(kept, first)[number.ravel()]
        corners = place[self.faces]
        whole = (corners != np.roll(corners, 1, axis=1)).all(axis=1)
        return SkinnedVertices(
            self.positions[kept], self.bones[kept], self.weights[kept], corners[whole]
        )


def skinned_vertices(file: GltfFile, pose: BindPose) -> SkinnedVertices:
    """Returns the vertices of all skinned meshes in the scene, whose bones are the pose's joints.

    Args:
        file: The file.
        pose: The bind pose of its skins.

    Raises:
        DataError: If they are invalid, or have no triangles.
    """
    parts, left_out = [], Counter[str]()
    for node in file.content.nodes:
        if node.skin is None or node.mesh is None:
            continue
        mesh = file.item(file.content.meshes, node.mesh, "mesh")
        members = np.array(pose.members[node.skin], dtype=np.intp)
        for primitive in mesh.primitives:
            if primitive.mode in (POINTS, *LINES):
                left_out["points or lines"] += 1
                continue
            if primitive.targets:
                left_out["morph targets"] += 1
            part = _part(file, primitive, len(members))
            positions = transformed(pose.shown[node.skin], part.positions)
            parts.append(replace(part, positions=positions, bones=members[part.bones]))
    for what, count in left_out.items():
        note(f"{what} of skinned meshes are left out: {count}", place=file.path)
    if not parts:
        raise file.wrong("no mesh that uses a skin has triangles")
    carriers = max(part.bones.shape[1] for part in parts)
    starts = np.cumsum([0, *(len(part.positions) for part in parts)])
    return SkinnedVertices(
        positions=np.concatenate([part.positions for part in parts]),
        bones=np.concatenate([_widened(part.bones, carriers) for part in parts]),
        weights=np.concatenate([_widened(part.weights, carriers) for part in parts]),
        faces=np.concatenate([s + part.faces for s, part in zip(starts, parts, strict=False)]),
    )


def _part(file: GltfFile, primitive: Any, joints: int) -> SkinnedVertices:
    """Returns the vertices of a primitive, whose bones are joints of its skin."""
    attributes = {
        key: value for key, value in vars(primitive.attributes).items() if value is not None
    }
    if "POSITION" not in attributes or "JOINTS_0" not in attributes:
        raise file.wrong("a mesh of the skin lacks POSITION or JOINTS_0")
    positions = file.floats(attributes["POSITION"])
    sets = [key.removeprefix("JOINTS_") for key in attributes if key.startswith("JOINTS_")]
    if any(f"WEIGHTS_{name}" not in attributes for name in sets):
        raise file.wrong("a mesh of the skin has JOINTS without WEIGHTS")
    bones = np.concatenate([file.integers(attributes[f"JOINTS_{name}"]) for name in sets], axis=1)
    weights = np.concatenate([file.floats(attributes[f"WEIGHTS_{name}"]) for name in sets], axis=1)
    if not len(positions) == len(bones) == len(weights) or bones.shape != weights.shape:
        raise file.wrong(
            f"a mesh has {len(positions)} positions, {bones.shape} joints and {weights.shape} "
            "weights; their numbers must be equal"
        )
    if len(positions) and np.abs(positions).max() > FARTHEST:
        raise file.wrong(
            f"a position is {np.abs(positions).max():.3g}, farther than any measurement"
        )
    if positions.shape[1] != 3:
        raise file.wrong(f"positions have {positions.shape[1]} coordinates; they need 3")
    if ((bones >= joints) & (weights != 0.0)).any():
        raise file.wrong(f"a vertex follows joint {int(bones.max())}; the skin has {joints} joints")
    sums = weights.sum(axis=1, keepdims=True)
    if (sums <= 0.0).any() or (weights < 0.0).any():
        vertex = int(np.argmax((sums[:, 0] <= 0.0) | (weights < 0.0).any(axis=1)))
        raise file.wrong(f"vertex {vertex} of a mesh follows no bone: {weights[vertex].tolist()}")
    uneven = np.abs(sums[:, 0] - 1.0) > ROUNDED
    if uneven.any():
        first = int(np.argmax(uneven))
        note(
            f"weights of {int(uneven.sum())} vertices do not sum to 1, those of vertex {first} to "
            f"{sums[first, 0]:.4g}; they are divided by their sums",
            place=file.path,
        )
    faces = triangles(file, primitive.indices, primitive.mode, len(positions))
    # Bones are sorted by weight; columns without any weight are dropped.
    order = np.argsort(-weights, axis=1, kind="stable")
    weights = np.take_along_axis(weights / sums, order, axis=1)
    bones = np.where(weights > 0.0, np.take_along_axis(bones, order, axis=1), 0)
    used = max(1, int((weights > 0.0).sum(axis=1).max()))
    return SkinnedVertices(positions, bones[:, :used], weights[:, :used], faces)


def _widened(rows: Any, columns: int) -> Any:
    return np.pad(rows, ((0, 0), (0, columns - rows.shape[1])))
