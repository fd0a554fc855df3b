"""The skinned vertices of a glTF file."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from regkit.interchange.gltf.file import GltfFile
from regkit.system.arrays import Array, Indices

TRIANGLES = 4
"""The mode of a primitive of individual triangles, section 3.7.2.1."""


@dataclass(frozen=True)
class SkinnedVertices:
    """V vertices, each skinned to up to A bones, and F triangles.

    Attributes:
        positions: Positions in the bind pose, (V, 3) [m].
        bones: Indices of the skin's joints, (V, A).
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


def skinned_vertices(file: GltfFile, joints: int) -> SkinnedVertices:
    """Returns the vertices of all meshes that are skinned to the file's skin.

    Args:
        file: The file.
        joints: Number of joints of the skin.

    Raises:
        DataError: If there are none, or they are invalid.
    """
    parts = [
        _part(file, primitive, joints)
        for node in file.content.nodes
        if node.skin is not None and node.mesh is not None
        for primitive in file.content.meshes[node.mesh].primitives
    ]
    if not parts:
        raise file.wrong("no mesh uses the skin; the file needs a skinned mesh")
    carriers = max(part.bones.shape[1] for part in parts)
    starts = np.cumsum([0, *(len(part.positions) for part in parts)])
    return SkinnedVertices(
        positions=np.concatenate([part.positions for part in parts]),
        bones=np.concatenate([_widened(part.bones, carriers) for part in parts]),
        weights=np.concatenate([_widened(part.weights, carriers) for part in parts]),
        faces=np.concatenate([s + part.faces for s, part in zip(starts, parts, strict=False)]),
    )


def _part(file: GltfFile, primitive: Any, joints: int) -> SkinnedVertices:
    if primitive.mode not in (None, TRIANGLES):
        raise file.wrong(
            f"a skinned mesh has the mode {primitive.mode}; only triangles (mode {TRIANGLES}) are "
            "supported"
        )
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
    if not len(positions) == len(bones) == len(weights):
        raise file.wrong(
            f"a mesh has {len(positions)} positions, {len(bones)} joints and {len(weights)} "
            "weights; their numbers must be equal"
        )
    if (bones >= joints).any():
        raise file.wrong(f"a vertex follows joint {int(bones.max())}; the skin has {joints} joints")
    sums = weights.sum(axis=1, keepdims=True)
    if (sums <= 0.0).any() or (weights < 0.0).any():
        vertex = int(np.argmax((sums[:, 0] <= 0.0) | (weights < 0.0).any(axis=1)))
        raise file.wrong(f"vertex {vertex} of a mesh follows no bone: {weights[vertex].tolist()}")
    if primitive.indices is None:
        faces = np.arange(len(positions))
    else:
        faces = file.integers(primitive.indices)[:, 0]
    if len(faces) % 3 or (faces >= len(positions)).any():
        raise file.wrong(
            f"a mesh has {len(faces)} triangle corners up to the vertex {int(faces.max())}, but "
            f"{len(positions)} vertices; corners must be a multiple of 3 and existing vertices"
        )
    # Bones are sorted by weight; columns without any weight are dropped.
    order = np.argsort(-weights, axis=1, kind="stable")
    weights = np.take_along_axis(weights / sums, order, axis=1)
    bones = np.where(weights > 0.0, np.take_along_axis(bones, order, axis=1), 0)
    used = max(1, int((weights > 0.0).sum(axis=1).max()))
    return SkinnedVertices(positions, bones[:, :used], weights[:, :used], faces.reshape(-1, 3))


def _widened(rows: Any, columns: int) -> Any:
    return np.pad(rows, ((0, 0), (0, columns - rows.shape[1])))
