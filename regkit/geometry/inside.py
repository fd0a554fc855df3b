"""Which points are inside a closed surface."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from regkit.system.arrays import Array, Indices
from regkit.system.optional import load_library


def inside(points: Array, vertices: Array, faces: Indices) -> NDArray[np.bool_]:
    """Returns which points (N,) are inside a closed mesh, by rays in three directions.

    Args:
        points: Points, (N, 3) [m].
        vertices: Vertices of the mesh, (V, 3) [m].
        faces: Vertex indices of its triangles, (F, 3).

    Raises:
        DependencyError: If Open3D is missing.
    """
    library = load_library("open3d")
    scene = library.t.geometry.RaycastingScene()
    scene.add_triangles(
        library.core.Tensor(np.ascontiguousarray(vertices, dtype=np.float32)),
        library.core.Tensor(np.ascontiguousarray(faces, dtype=np.uint32)),
    )
    queries = library.core.Tensor(np.ascontiguousarray(points, dtype=np.float32))
    occupied = scene.compute_occupancy(queries, nsamples=3)
    return np.asarray(occupied.numpy() > 0.5)
