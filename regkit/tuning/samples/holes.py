"""Holes of meshes, such as the wrist of a hand: where they are open, and how they are closed."""

from __future__ import annotations

import numpy as np

from regkit.body import Body
from regkit.system.arrays import Array, Indices

WIDE = 0.01
"""Area of a hole, as a fraction of the surface, from which on the body goes on there."""


def closed(faces: Indices) -> Indices:
    """Returns triangles (F, 3) and those that close the holes between them, around a vertex each.

    Args:
        faces: Vertex indices of the triangles, counter-clockwise seen from outside.
    """
    edges = {(face[corner - 1], face[corner]) for face in faces.tolist() for corner in range(3)}
    after = dict(edge for edge in sorted(edges) if edge[::-1] not in edges)
    lids: list[tuple[int, int, int]] = []
    while after:
        first, last = min(after.items())
        del after[first]
        while last in after:
            following = after.pop(last)
            if following != first:
                lids.append((first, following, last))
            last = following
    return np.concatenate([faces, np.array(lids, dtype=faces.dtype).reshape(-1, 3)])


def opening(body: Body) -> Array | None:
    """Returns the direction (3,) in which a body's mesh is open at rest; None if it is closed.

    The area vectors of a closed surface have no sum; what is missing is that of the hole.
    """
    surface = body.surface
    if surface is None or not len(surface.faces):
        return None
    corners = surface.place(body.place(body.skeleton.rest()).transforms)[surface.faces]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    missing = -areas.sum(axis=0)
    area = float(np.linalg.norm(missing))
    wide = area > WIDE * np.linalg.norm(areas, axis=1).sum()
    return missing / area if wide else None
