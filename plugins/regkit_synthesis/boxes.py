"""Triangles of boxes."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array, Indices

_BOX = np.array([
    [0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
    [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5],
])  # fmt: skip
"""Triangles of a box, counter-clockwise seen from outside; bits of a corner's number: x, y, z."""


def boxes(ends: Array) -> tuple[Array, Indices]:
    """Returns vertices (8 B, 3) [m] and faces (12 B, 3) of boxes.

    Args:
        ends: The least and the largest coordinates of each box, (B, 2, 3) [m].
    """
    bits = np.array([[corner >> axis & 1 for axis in range(3)] for corner in range(8)])
    vertices = ends[:, bits, np.arange(3)].reshape(-1, 3)
    faces = (8 * np.arange(len(ends))[:, None, None] + _BOX).reshape(-1, 3)
    return vertices, faces
