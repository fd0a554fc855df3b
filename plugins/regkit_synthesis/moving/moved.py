"""Moved bodies: a mesh with its landmarks and the poses of its bones over time."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array, Indices
from regkit_synthesis.bodies.landmarks import Landmark


@dataclass(frozen=True)
class Moved:
    """What a scene renders of its bodies.

    Attributes:
        mesh: The mesh at rest.
        landmarks: Joints, by name.
        bone_poses: Function from a time [s] to bone poses ``T_ground_bone`` (J, 4, 4).
        markers: Additional markers, by name: vertices of the mesh.
    """

    mesh: SkinnedMesh
    landmarks: Mapping[str, Landmark]
    bone_poses: Callable[[float], Array]
    markers: Mapping[str, int] = field(default_factory=dict)

    def along(self, course: Callable[[float], Array]) -> Moved:
        """Returns the body carried along a course.

        Args:
            course: Function from a time [s] to ``T_ground_own`` (4, 4).
        """
        return replace(
            self, bone_poses=lambda time: np.asarray(course(time) @ self.bone_poses(time))
        )

    @classmethod
    def joined(cls, parts: Mapping[str, Moved]) -> Moved:
        """Returns several bodies as one mesh; names begin with those of the parts.

        Args:
            parts: The bodies by name.
        """
        bones = np.cumsum([0, *(len(part.mesh.labels) for part in parts.values())]).tolist()
        vertices = np.cumsum([0, *(len(part.mesh.vertices) for part in parts.values())]).tolist()
        landmarks, markers = {}, {}
        for (name, part), bone, vertex in zip(parts.items(), bones, vertices, strict=False):
            for label, mark in part.landmarks.items():
                landmarks[of_part(name, label)] = replace(mark, bone=mark.bone + bone)
            for label, own in part.markers.items():
                markers[of_part(name, label)] = own + vertex
        each = [part.bone_poses for part in parts.values()]
        return cls(
            _joined_mesh({name: part.mesh for name, part in parts.items()}, bones, vertices),
            landmarks,
            lambda time: np.concatenate([poses(time) for poses in each]),
            markers,
        )


def of_part(part: str, name: str) -> str:
    """Returns the name of a part's joint in a whole of several bodies."""
    return f"{part}_{name}"


def _joined_mesh(
    meshes: Mapping[str, SkinnedMesh], bones: list[int], vertices: list[int]
) -> SkinnedMesh:
    widest = max(mesh.weights.shape[1] for mesh in meshes.values())

    def padded(array: Array | Indices) -> Array:
        return np.pad(array, [(0, 0), (0, widest - array.shape[1])])

    some = list(zip(meshes.items(), bones, vertices, strict=False))
    return SkinnedMesh(
        vertices=np.concatenate([mesh.vertices for mesh in meshes.values()]),
        faces=np.concatenate([mesh.faces + vertex for (_, mesh), _, vertex in some]),
        labels=tuple(of_part(name, label) for (name, mesh), _, _ in some for label in mesh.labels),
        parents=np.concatenate(
            [np.where(mesh.parents < 0, -1, mesh.parents + bone) for (_, mesh), bone, _ in some]
        ),
        rest=np.concatenate([mesh.rest for mesh in meshes.values()]),
        indices=np.concatenate([padded(mesh.indices) + bone for (_, mesh), bone, _ in some]),
        weights=np.concatenate([padded(mesh.weights) for mesh in meshes.values()]),
    )
