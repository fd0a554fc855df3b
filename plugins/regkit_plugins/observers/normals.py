"""Normals of a cloud."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from regkit.arrays import Array


def normals(points: Array, neighbours: int) -> Array:
    """The unit normal (N, 3) of the plane through each point's neighbours, of either sign.

    It is the direction in which the neighbours, the point among them, spread least.
    """
    count = min(neighbours + 1, len(points))
    near = points[cKDTree(points).query(points, k=count)[1]]
    offsets = near - near.mean(axis=1, keepdims=True)
    _, vectors = np.linalg.eigh(offsets.swapaxes(1, 2) @ offsets)
    return np.asarray(vectors[:, :, 0])
