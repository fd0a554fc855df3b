"""Distances of points to a triangle mesh."""

from __future__ import annotations

import numpy as np
import scipy

from regkit.system.arrays import Array, Indices
from regkit.system.optional import load_library

NEIGHBOURS = 12
"""Number of triangles with the nearest centres among which the nearest triangle is sought."""


def mesh_distances(points: Array, vertices: Array, faces: Indices) -> Array:
    """Returns the distances of points to the surface of a mesh, (N,) [m].

    The triangles should be of about the same size: the nearest one is sought among those with the
    nearest centres.

    Args:
        points: The points, (N, 3) [m].
        vertices: Vertices of the mesh, (V, 3) [m].
        faces: Vertex indices of the triangles, (F, 3).

    Raises:
        DependencyError: If trimesh is missing.
    """
    corners = vertices[faces]
    centres = scipy.spatial.cKDTree(corners.mean(axis=1))
    count = min(NEIGHBOURS, len(faces))
    near = np.asarray(centres.query(points, k=count)[1]).reshape(len(points), count)
    closest = load_library("trimesh").triangles.closest_point
    least = np.full(len(points), np.inf)
    for rank in range(count):
        feet = np.asarray(closest(corners[near[:, rank]], points))
        least = np.minimum(least, np.linalg.norm(points - feet, axis=1))
    return least
