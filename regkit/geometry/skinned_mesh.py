"""Triangle meshes that bones deform by linear blend skinning."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from regkit.geometry.mesh_file import (
    FARTHEST,
    Arrays,
    checked_bones,
    checked_indices,
    checked_labels,
    checked_shape,
    checked_weights,
    mesh_arrays,
)
from regkit.geometry.rigid import rigid
from regkit.system.arrays import Array, Indices, read_only
from regkit.system.brief import Brief
from regkit.system.errors import DataError
from regkit.system.files import write_arrays
from regkit.system.guard import reading

KEYS = (
    "rest_vertices",
    "faces",
    "labels",
    "parents",
    "rest_bone_poses",
    "skin_indices",
    "skin_weights",
)
"""Names of the arrays in a mesh file, in the order of the fields of ``SkinnedMesh``."""

SHAPE_KEYS = ("rest_vertices", "rest_bone_poses")
"""Names of the arrays that differ between people; topology and skin weights are shared."""


@dataclass(frozen=True)
class SkinnedMesh(Brief):
    """A mesh with V vertices, each skinned to up to A of J bones.

    Attributes:
        vertices: Vertices of the rest pose in the body frame, (V, 3) [m].
        faces: Vertex indices of the triangles, (F, 3), counter-clockwise seen from outside.
        labels: Names of the J bones, parents before children.
        parents: Index of each bone's parent, (J,); -1 for the root.
        rest: Bone poses ``T_body_bone`` of the rest pose, (J, 4, 4) [m]; y points along the bone.
        indices: Bones of each vertex, (V, A).
        weights: Skinning weights, (V, A); every row sums to one.
    """

    vertices: Array
    faces: Indices
    labels: tuple[str, ...]
    parents: Indices
    rest: Array
    indices: Indices
    weights: Array

    @classmethod
    def read(cls, path: Path) -> SkinnedMesh:
        """Reads an ``.npz`` file with the arrays ``KEYS``.

        Weights that do not sum to one are divided by their sums, which is told.

        Raises:
            DataError: If the file is missing or damaged, or one of the arrays is missing or wrong.
        """
        arrays = mesh_arrays(path, KEYS)
        with reading(path, "a skinned mesh"):
            return cls.of(arrays, path)

    @classmethod
    def of(cls, arrays: Arrays, path: Path) -> SkinnedMesh:
        """Returns the mesh of the arrays ``KEYS``, which are checked.

        Args:
            arrays: The arrays by name.
            path: Their file, for notes.

        Raises:
            DataError: If one of them is wrong.
        """
        labels = checked_labels(arrays, "labels", "parents")
        vertices = checked_shape(arrays, "rest_vertices", None, 3, most=FARTHEST)
        weights = checked_weights(arrays, "skin_weights", path)
        carriers = arrays["skin_indices"]
        if carriers.shape != weights.shape or len(weights) != len(vertices):
            raise DataError(
                f"skin_indices has the shape {carriers.shape}, skin_weights {weights.shape}; "
                f"both need a row for each of the {len(vertices)} vertices"
            )
        # The bones of places without weight are padding.
        carried = {"skin_indices": np.where(weights > 0.0, carriers, 0)}
        return cls(
            read_only(vertices),
            checked_indices(arrays, "faces", 3, 0, len(vertices)),
            labels,
            arrays["parents"].astype(np.intp),
            read_only(checked_bones(arrays, "rest_bone_poses", len(labels))),
            checked_indices(carried, "skin_indices", None, 0, len(labels)),
            read_only(weights),
        )

    def write(self, path: Path) -> None:
        """Writes an ``.npz`` file that ``read`` accepts.

        Raises:
            DataError: If the file cannot be written.
        """
        values = (
            self.vertices.astype(np.float32),
            self.faces.astype(np.uint32),
            np.array(self.labels),
            self.parents.astype(np.int16),
            self.rest.astype(np.float32),
            self.indices.astype(np.uint16),
            self.weights.astype(np.float32),
        )
        write_arrays(path, dict(zip(KEYS, values, strict=True)))

    def reshaped(self, path: Path) -> SkinnedMesh:
        """Returns the mesh with another person's shape, read from an ``.npz`` file.

        The file holds the arrays ``SHAPE_KEYS``.

        Raises:
            DataError: If the file is missing, is not an ``.npz`` file, lacks one of the arrays, or
                belongs to a mesh of another topology.
        """
        arrays = mesh_arrays(path, SHAPE_KEYS)
        own = {"rest_vertices": self.vertices, "rest_bone_poses": self.rest}
        for key, array in arrays.items():
            if array.shape != own[key].shape:
                raise DataError(
                    f"{key} has the shape {array.shape}; for this mesh it must be {own[key].shape}",
                    place=str(path),
                )
        with reading(path, "the shape of a skinned mesh"):
            return replace(
                self,
                vertices=read_only(checked_shape(arrays, "rest_vertices", None, 3, most=FARTHEST)),
                rest=read_only(checked_bones(arrays, "rest_bone_poses", len(self.labels))),
            )

    def scaled(self, scale: float) -> SkinnedMesh:
        """Returns the mesh with all lengths multiplied by a factor."""
        rest = rigid(self.rest[:, :3, :3], scale * self.rest[:, :3, 3])
        return replace(self, vertices=scale * self.vertices, rest=rest)

    def bone(self, label: str) -> int:
        """Returns the index of the bone named ``label``.

        Raises:
            DataError: If the mesh has no such bone.
        """
        if label not in self.labels:
            raise DataError(f"the mesh has no bone '{label}'; it has {', '.join(self.labels)}")
        return self.labels.index(label)

    def origin(self, label: str) -> Array:
        """Returns the origin (3,) [m] of the bone named ``label`` in the rest pose.

        Raises:
            DataError: If the mesh has no such bone.
        """
        return np.array(self.rest[self.bone(label), :3, 3])

    def motions(self, bone_poses: Array) -> Array:
        """Returns the motion (J, 4, 4) of each bone from rest to ``bone_poses`` (J, 4, 4)."""
        # The rest poses are orthogonal to float32 only, so the transpose is not an exact inverse.
        return np.asarray(bone_poses @ np.linalg.inv(self.rest))

    def posed(self, bone_poses: Array) -> Array:
        """Returns the skinned vertices (V, 3) [m] for bone poses ``T_world_bone`` (J, 4, 4).

        Source: Lewis, Cordner, Fong, Pose Space Deformation, SIGGRAPH 2000, eq. 1:
        ``v = sum_a w_a T_bone,a T_rest,a^-1 v_rest``.
        """
        motions = self.motions(bone_poses)[:, :3]
        blended = np.einsum("va,vaij->vij", self.weights, motions[self.indices])
        return np.asarray(
            np.einsum("vij,vj->vi", blended[:, :, :3], self.vertices) + blended[:, :, 3]
        )

    def stretched(self, matrices: Array) -> SkinnedMesh:
        """Returns the rest mesh with every bone scaled or sheared, keeping the joints connected.

        Args:
            matrices: Linear map of positions in each bone's frame, (J, 3, 3).
        """
        inverse = np.linalg.inv(self.rest)
        origins = self.rest[:, :3, 3].copy()
        for bone in np.flatnonzero(self.parents >= 0):
            parent = self.parents[bone]
            local = inverse[parent, :3, :3] @ (self.rest[bone, :3, 3] - self.rest[parent, :3, 3])
            offset = self.rest[parent, :3, :3] @ matrices[parent] @ local
            origins[bone] = origins[parent] + offset
        rest = rigid(self.rest[:, :3, :3], origins)
        carriers = np.zeros((len(rest), 4, 4))
        carriers[:, :3, :3] = rest[:, :3, :3] @ matrices
        carriers[:, :3, 3] = origins
        carriers[:, 3, 3] = 1.0
        return replace(self, vertices=self.posed(carriers), rest=rest)

    def rotated(self, rotations: Array, root: Array) -> Array:
        """Returns bone poses ``T_world_bone`` (J, 4, 4) after rotating every bone from rest.

        The joints stay connected, so the bone lengths are those of the rest pose.

        Args:
            rotations: Rotation of each bone from rest in world axes, (J, 3, 3).
            root: Origin of the first bone in the world, (3,) [m].
        """
        origins = self.rest[:, :3, 3].copy()
        offsets = origins - origins[self.parents]
        origins[0] = root
        for bone in range(1, len(self.labels)):
            parent = self.parents[bone]
            origins[bone] = origins[parent] + rotations[parent] @ offsets[bone]
        return rigid(rotations @ self.rest[:, :3, :3], origins)
