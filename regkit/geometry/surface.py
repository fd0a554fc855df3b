"""Skinned surfaces: points that one or several segments carry, with or without triangles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Self

import numpy as np

from regkit.config.model import did_you_mean
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array, Indices
from regkit.system.errors import DataError


@dataclass(frozen=True)
class SkinnedSurface:
    """A body's measured or modelled surface: the vertices of a mesh, or the points of a cloud.

    Each of V vertices follows A segments, by linear blend skinning; a rigid cloud has A = 1.

    Attributes:
        segments: The segments that carry each vertex, (V, A).
        points: Where each of them carries it, in that segment's frame, (V, A, 3) [m].
        blend: By how much each of them does, (V, A); the rows sum to one.
        normals: Unit outward normals in the segments' frames, (V, A, 3), or None if unknown.
        faces: The vertices of each triangle, (F, 3); none for a cloud.
    """

    segments: Indices
    points: Array
    blend: Array
    normals: Array | None
    faces: Indices

    @classmethod
    def of(cls, mesh: SkinnedMesh) -> Self:
        """The surface of a mesh whose bones are the segments, in their order."""
        # The rest poses are only orthogonal to float32, so that a transpose would not invert them.
        carried = np.linalg.inv(mesh.rest)[mesh.indices, :3]
        normals = vertex_normals(mesh.vertices, mesh.faces)
        points = np.einsum("vaij,vj->vai", carried[..., :3], mesh.vertices) + carried[..., 3]
        return cls(
            segments=mesh.indices,
            points=points,
            # Their rows sum to one only to float32.
            blend=mesh.weights / mesh.weights.sum(axis=1, keepdims=True),
            normals=np.einsum("vaij,vj->vai", carried[..., :3], normals),
            faces=mesh.faces,
        )

    def __len__(self) -> int:
        """Number V of vertices."""
        return len(self.segments)

    def place(self, transforms: Array) -> Array:
        """Positions in the world, (V, 3) [m], for T_world_segment (S, 4, 4)."""
        carriers = transforms[self.segments]
        carried = np.einsum("vaij,vaj->vai", carriers[..., :3, :3], self.points)
        carried += carriers[..., :3, 3]
        return np.asarray(np.einsum("va,vai->vi", self.blend, carried))

    def scaled(self, factor: float) -> Self:
        """The same surface on a skeleton whose lengths are multiplied by ``factor``."""
        return replace(self, points=factor * self.points)


def surface_in(path: Path, segments: Sequence[str]) -> SkinnedSurface:
    """The surface of the mesh in a file, whose bones are named as segments are.

    The file is read again only if it has changed.

    Raises:
        DataError: If the file is missing or is no mesh, or a vertex follows a bone that no segment
            is named after.
    """
    changed = path.stat().st_mtime_ns if path.is_file() else 0
    return _read(path, changed, tuple(segments))


@lru_cache(maxsize=8)
def _read(path: Path, changed: int, segments: tuple[str, ...]) -> SkinnedSurface:
    mesh = SkinnedMesh.read(path)
    order = np.zeros(len(mesh.labels), dtype=np.intp)
    for bone in np.unique(mesh.indices[mesh.weights > 0.0]):
        label = mesh.labels[bone]
        if label not in segments:
            raise DataError(
                f"the mesh's bone '{label}' is not a segment (there are: {', '.join(segments)})"
                + did_you_mean(label, list(segments)),
                place=str(path),
            )
        order[bone] = segments.index(label)
    surface = SkinnedSurface.of(mesh)
    return replace(surface, segments=order[surface.segments])


def vertex_normals(vertices: Array, faces: Indices) -> Array:
    """Unit normals (V, 3): the mean of those of a vertex's triangles, by their areas.

    A vertex of no triangle has the normal zero.
    """
    corners = vertices[faces]
    crossed = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sums = np.zeros_like(vertices)
    for corner in range(3):
        np.add.at(sums, faces[:, corner], crossed)
    lengths = np.linalg.norm(sums, axis=1, keepdims=True)
    return np.asarray(sums / np.where(lengths > 0.0, lengths, 1.0))
