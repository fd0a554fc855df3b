"""Skinned surfaces: points that one or several segments carry, with or without triangles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.arrays import Array, Indices


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

    def __len__(self) -> int:
        """Number V of vertices."""
        return len(self.segments)

    def place(self, transforms: Array) -> Array:
        """Positions in the world, (V, 3) [m], for T_world_segment (S, 4, 4)."""
        carriers = transforms[self.segments]
        carried = np.einsum("vaij,vaj->vai", carriers[..., :3, :3], self.points)
        carried += carriers[..., :3, 3]
        return np.asarray(np.einsum("va,vai->vi", self.blend, carried))
