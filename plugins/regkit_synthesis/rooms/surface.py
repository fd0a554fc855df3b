"""Surfaces: the triangles of a part of a room, still or moving."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from regkit.geometry.rigid import transformed
from regkit.system.arrays import Array, Indices

_QUAD = np.array([[0, 1, 2], [0, 2, 3]])


@dataclass(frozen=True)
class Surface:
    """Triangles whose vertices may move.

    Attributes:
        faces: Vertex indices of the triangles, (F, 3).
        vertices: Function from a time [s] to the vertices, (V, 3) [m].
        still: Whether the vertices are the same at all times.
    """

    faces: Indices
    vertices: Callable[[float], Array]
    still: bool

    @classmethod
    def at_rest(cls, vertices: Array, faces: Indices) -> Surface:
        """Returns a surface that does not move."""
        return cls(faces, lambda time: vertices, still=True)

    def moved(self, T_a_b: Array) -> Surface:
        """Returns the surface in frame a, by ``T_a_b`` (4, 4)."""
        return replace(self, vertices=lambda time: transformed(T_a_b, self.vertices(time)))


def quad(corners: Array) -> Surface:
    """Returns the surface of four corners (4, 3) [m] in their order around it."""
    return Surface.at_rest(corners, _QUAD)
