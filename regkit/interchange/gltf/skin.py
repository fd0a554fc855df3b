"""The vertices of a glTF file that follow its skin."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from regkit.interchange.gltf.file import GltfFile
from regkit.system.arrays import Array, Indices

TRIANGLES = 4
"""The mode of a primitive of separate triangles, section 3.7.2.1."""


@dataclass(frozen=True)
class SkinnedVertices:
    """V vertices that follow up to A bones each, and F triangles of them.

    Attributes:
        positions: (V, 3) in the skin's bind pose.
        bones: (V, A) indices into the skin's joints.
        weights: (V, A); the rows sum to one.
        faces: (F, 3).
    """

    positions: Array
    bones: Indices
    weights: Array
    faces: Indices

    def joined(self) -> SkinnedVertices:
        """The same surface, with vertices made one that are at one place and move alike."""
        # Weights come in several precisions.
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
    """The vertices of all meshes that follow the file's skin, whose ``joints`` are so many.

    Raises:
        DataError: If there are none, or they cannot be read.
    """
    parts = [
        _part(file, primitive, joints)
        for node in file.content.nodes
        if node.skin is not None and node.mesh is not None
        for primitive in file.content.meshes[node.mesh].primitives
    ]
    if not parts:
        raise file.wrong("no mesh follows the skin")
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
            f"a skinned mesh is drawn in mode {primitive.mode}; only triangles (mode {TRIANGLES}) "
            "are read"
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
        raise file.wrong("a mesh has other numbers of positions than of joints or weights")
    if (bones >= joints).any():
        raise file.wrong(f"a vertex follows joint {int(bones.max())}; the skin has {joints}")
    sums = weights.sum(axis=1, keepdims=True)
    if (sums <= 0.0).any() or (weights < 0.0).any():
        vertex = int(np.argmax((sums[:, 0] <= 0.0) | (weights < 0.0).any(axis=1)))
        raise file.wrong(f"vertex {vertex} of a mesh follows no bone: {weights[vertex].tolist()}")
    if primitive.indices is None:
        faces = np.arange(len(positions))
    else:
        faces = file.integers(primitive.indices)[:, 0]
    if len(faces) % 3 or (faces >= len(positions)).any():
        raise file.wrong("a mesh's triangles have corners that there are not")
    # The heaviest carriers come first; columns in which no vertex has a weight are left out.
    order = np.argsort(-weights, axis=1, kind="stable")
    weights = np.take_along_axis(weights / sums, order, axis=1)
    bones = np.where(weights > 0.0, np.take_along_axis(bones, order, axis=1), 0)
    used = max(1, int((weights > 0.0).sum(axis=1).max()))
    return SkinnedVertices(positions, bones[:, :used], weights[:, :used], faces.reshape(-1, 3))


def _widened(rows: Any, columns: int) -> Any:
    return np.pad(rows, ((0, 0), (0, columns - rows.shape[1])))
