"""Points on the surface of a mesh."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array, Indices, measured_points
from regkit.system.errors import DataError
from regkit.system.notes import note

MESH_SAMPLES = 20_000
"""Number of points sampled from the surface of a mesh."""


def surface_points(vertices: Array, triangles: Indices, *, place: str) -> Array:
    """Returns uniform samples (``MESH_SAMPLES``, 3) of a mesh; without triangles, its vertices.

    The seed is fixed.

    Args:
        vertices: The vertices, (V, 3) [m].
        triangles: Corners of the triangles, (T, 3).
        place: The file, for messages.

    Raises:
        DataError: If a vertex of a mesh is not finite, or its triangles cover no area.
    """
    if not len(triangles):
        return vertices
    if len(measured_points(vertices, place=place)) < len(vertices):
        raise DataError("a vertex of the mesh is NaN or infinite", place=place)
    unused = len(vertices) - len(np.unique(triangles))
    if unused:
        note(
            f"{unused} of {len(vertices)} vertices belong to no face; only the faces are sampled",
            place=place,
        )
    corners = vertices[triangles]
    sides = corners[:, 1:] - corners[:, :1]
    areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    if not areas.sum() > 0.0:
        raise DataError(f"the {len(triangles)} faces of the mesh cover no area", place=place)
    random = np.random.default_rng(0)
    chosen = random.choice(len(areas), size=MESH_SAMPLES, p=areas / areas.sum())
    first, second = random.uniform(size=(2, MESH_SAMPLES, 1))
    # The square root makes the density uniform: Osada et al., Shape distributions, 2002, eq. 1.
    root = np.sqrt(first)
    a, b, c = corners[chosen].transpose(1, 0, 2)
    return np.asarray((1.0 - root) * a + root * (1.0 - second) * b + root * second * c)
