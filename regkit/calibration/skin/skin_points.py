"""Points spread over a triangle mesh, which move with its vertices."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.system.arrays import Array, Indices

CENTRES = np.array([
    [4.0, 1.0, 1.0], [1.0, 4.0, 1.0], [1.0, 1.0, 4.0], [2.0, 2.0, 2.0]
]) / 6.0  # fmt: skip
"""Barycentric coordinates of the centres of the four equal parts of a triangle, (4, 3)."""

FEWEST = 8000
"""A mesh with fewer triangles has four points on each, otherwise one."""


@dataclass(frozen=True)
class SkinPoints:
    """Q points on the triangles of a mesh.

    Attributes:
        corners: Vertices of each point's triangle, (Q, 3).
        shares: Barycentric coordinates of the points, (Q, 3).
    """

    corners: Indices
    shares: Array

    @classmethod
    def on(cls, faces: Indices) -> SkinPoints:
        """Returns points on all triangles (F, 3)."""
        centres = CENTRES if len(faces) < FEWEST else CENTRES[3:]
        return cls(np.repeat(faces, len(centres), axis=0), np.tile(centres, (len(faces), 1)))

    def place(self, vertices: Array) -> Array:
        """Returns the points (Q, 3) [m] on the triangles of vertices (V, 3)."""
        return np.asarray(np.einsum("qc,qci->qi", self.shares, vertices[self.corners]))

    def normals(self, vertices: Array) -> Array:
        """Returns the unit normals (Q, 3) of the points' triangles; zero for one without area."""
        corners = vertices[self.corners]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        lengths = np.linalg.norm(normals, axis=1, keepdims=True)
        return np.asarray(normals / np.where(lengths > 0.0, lengths, 1.0))
