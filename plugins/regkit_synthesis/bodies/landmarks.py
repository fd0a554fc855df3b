"""Landmarks: the joints of a body as points on the bones of its mesh."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from regkit.geometry.rigid import transformed
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array, Indices

_FINGERS = {
    "thumb": ("cmc", "mcp", "ip"),
    "index": ("mcp", "pip", "dip"),
    "middle": ("mcp", "pip", "dip"),
    "ring": ("mcp", "pip", "dip"),
    "little": ("mcp", "pip", "dip"),
}
"""The joints of each finger from the palm outwards; finger k + 1 of the mesh is the k-th here."""


@dataclass(frozen=True)
class Landmark:
    """A point on a bone.

    Attributes:
        bone: Index of the bone.
        position: Position at rest in the body frame, (3,) [m].
    """

    bone: int
    position: Array


def hand_landmarks(mesh: SkinnedMesh, side: str = "R") -> dict[str, Landmark]:
    """Returns the wrist and the 20 joints and tips of the fingers, by name.

    Args:
        mesh: The mesh of a hand.
        side: Suffix of its bones, ``R`` or ``L``.
    """
    landmarks = {"wrist": Landmark(mesh.bone(f"wrist.{side}"), mesh.origin(f"wrist.{side}"))}
    for number, (finger, joints) in enumerate(_FINGERS.items(), start=1):
        for part, joint in enumerate(joints, start=1):
            label = f"finger{number}-{part}.{side}"
            landmarks[f"{finger}_{joint}"] = Landmark(mesh.bone(label), mesh.origin(label))
        landmarks[f"{finger}_tip"] = _tip(mesh, mesh.bone(f"finger{number}-3.{side}"))
    return landmarks


def some_vertices(mesh: SkinnedMesh, vertices: Indices) -> SkinnedMesh:
    """Returns the mesh with the vertices (N,) only, without triangles."""
    return replace(
        mesh,
        vertices=mesh.vertices[vertices],
        faces=np.zeros((0, 3), dtype=np.intp),
        indices=mesh.indices[vertices],
        weights=mesh.weights[vertices],
    )


def placed(landmarks: Mapping[str, Landmark], mesh: SkinnedMesh, bone_poses: Array) -> Array:
    """Returns the landmarks (L, 3) [m] in the world for bone poses ``T_world_bone`` (J, 4, 4)."""
    motions = mesh.motions(bone_poses)
    bones = [landmark.bone for landmark in landmarks.values()]
    positions = np.array([landmark.position for landmark in landmarks.values()])
    return transformed(motions[bones], positions)


def _tip(mesh: SkinnedMesh, bone: int) -> Landmark:
    """Returns the farthest vertex along ``bone``, among those with the largest weight on it."""
    strongest = np.take_along_axis(mesh.indices, np.argmax(mesh.weights, axis=1)[:, None], axis=1)[
        :, 0
    ]
    own = np.flatnonzero(strongest == bone)
    along = mesh.vertices[own] @ mesh.rest[bone, :3, 1]
    return Landmark(bone, mesh.vertices[own[np.argmax(along)]])
