"""Skinned surfaces: vertices in segment frames, with or without triangles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Self

import numpy as np

from regkit.config.model import did_you_mean
from regkit.geometry.rigid import rigid
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array, Indices
from regkit.system.brief import Brief
from regkit.system.errors import DataError


@dataclass(frozen=True)
class SkinnedSurface(Brief):
    """The measured or modelled surface of a body: the vertices of a mesh or the points of a cloud.

    Each of V vertices is skinned to A segments by linear blend skinning; a rigid cloud has A = 1.

    Attributes:
        segments: Segments of each vertex, (V, A).
        points: Position of the vertex in the frame of each of its segments, (V, A, 3) [m].
        blend: Skinning weights, (V, A); the rows sum to one.
        normals: Unit outward normals in the segment frames, (V, A, 3), or None if unknown.
        faces: Vertex indices of the triangles, (F, 3); F = 0 for a cloud.
        rest: Poses of the segments in which the mesh was made, where all of a vertex's segments
            place it alike, (S, 4, 4) [m]; None for a cloud.
    """

    segments: Indices
    points: Array
    blend: Array
    normals: Array | None
    faces: Indices
    rest: Array | None = None

    @classmethod
    def of(cls, mesh: SkinnedMesh) -> Self:
        """Returns the surface of a mesh whose bones are the segments, in the same order."""
        # The rest poses are orthogonal to float32 only, so the transpose is not an exact inverse.
        carried = np.linalg.inv(mesh.rest)[mesh.indices, :3]
        normals = vertex_normals(mesh.vertices, mesh.faces)
        points = np.einsum("vaij,vj->vai", carried[..., :3], mesh.vertices) + carried[..., 3]
        return cls(
            segments=mesh.indices,
            points=points,
            # The stored weights sum to one in float32 only.
            blend=mesh.weights / mesh.weights.sum(axis=1, keepdims=True),
            normals=np.einsum("vaij,vj->vai", carried[..., :3], normals),
            faces=mesh.faces,
            rest=mesh.rest,
        )

    def __len__(self) -> int:
        """Number V of vertices."""
        return len(self.segments)

    def place(self, transforms: Array) -> Array:
        """Returns world positions (V, 3) [m] for T_world_segment (S, 4, 4)."""
        carriers = transforms[self.segments]
        carried = np.einsum("vaij,vaj->vai", carriers[..., :3, :3], self.points)
        carried += carriers[..., :3, 3]
        return np.asarray(np.einsum("va,vai->vi", self.blend, carried))

    def unblended(self) -> tuple[Indices, Array, Array | None]:
        """Returns the segment (V,) with the largest weight, and position and normal (V, 3) in it.

        Of a rigid cloud these are the surface's own arrays, which may be large.
        """
        if self.blend.shape[1] == 1:
            normals = None if self.normals is None else self.normals[:, 0]
            return self.segments[:, 0], self.points[:, 0], normals
        own = np.arange(len(self)), self.blend.argmax(axis=1)
        normals = None if self.normals is None else self.normals[own]
        return self.segments[own], self.points[own], normals

    def scaled(self, factor: float) -> Self:
        """Returns the surface with all lengths multiplied by ``factor``."""
        rest = self.rest
        if rest is not None:
            rest = rigid(rest[:, :3, :3], factor * rest[:, :3, 3])
        return replace(self, points=factor * self.points, rest=rest)


def surface_in(path: Path, segments: Sequence[str]) -> SkinnedSurface:
    """Reads the surface of a skinned mesh whose bones are named like the segments.

    The result is cached until the file changes.

    Args:
        path: An ``.npz`` file of a ``SkinnedMesh``.
        segments: Names of the segments, in the order of the skeleton.

    Raises:
        DataError: If the file is missing, is not a mesh, or skins a vertex to a bone that has no
            segment of its name.
    """
    changed = path.stat().st_mtime_ns if path.is_file() else 0
    return _read(path, changed, tuple(segments))


@lru_cache(maxsize=8)
def _read(path: Path, changed: int, segments: tuple[str, ...]) -> SkinnedSurface:
    return surface_on(SkinnedMesh.read(path), segments, place=str(path))


def surface_on(mesh: SkinnedMesh, segments: Sequence[str], *, place: str) -> SkinnedSurface:
    """Returns the surface of a skinned mesh whose bones are named like the segments.

    Args:
        mesh: The mesh.
        segments: Names of the segments, in the order of the skeleton.
        place: Where the mesh is from, for messages.

    Raises:
        DataError: If it skins a vertex to a bone that has no segment of its name.
    """
    order = np.zeros(len(mesh.labels), dtype=np.intp)
    used = np.unique(mesh.indices[mesh.weights > 0.0])
    for bone in used:
        label = mesh.labels[bone]
        if label not in segments:
            raise DataError(
                f"the mesh's bone '{label}' is not a segment (there are: {', '.join(segments)})"
                + did_you_mean(label, list(segments)),
                place=place,
            )
        order[bone] = segments.index(label)
    surface = SkinnedSurface.of(mesh)
    rest = np.tile(np.eye(4), (len(segments), 1, 1))
    rest[order[used]] = mesh.rest[used]
    return replace(surface, segments=order[surface.segments], rest=rest)


def vertex_normals(vertices: Array, faces: Indices) -> Array:
    """Returns unit normals (V, 3), averaged over adjacent triangles with their areas as weights.

    A vertex without a triangle has a zero normal.

    Args:
        vertices: Vertex positions, (V, 3) [m].
        faces: Vertex indices of the triangles, (F, 3).
    """
    corners = vertices[faces]
    crossed = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sums = np.zeros_like(vertices)
    for corner in range(3):
        np.add.at(sums, faces[:, corner], crossed)
    lengths = np.linalg.norm(sums, axis=1, keepdims=True)
    return np.asarray(sums / np.where(lengths > 0.0, lengths, 1.0))
