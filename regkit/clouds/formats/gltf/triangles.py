"""The triangles of a mesh's primitive.

Source: The Khronos Group, glTF 2.0 Specification, section 3.7.2.1 (primitives).
"""

from __future__ import annotations

import numpy as np

from regkit.clouds.formats.gltf.data import GltfData
from regkit.system.arrays import Indices

POINTS, LINES = 0, (1, 2, 3)
"""The modes of primitives without triangles."""

_TRIANGLES, _STRIP, _FAN = 4, 5, 6


def triangles(file: GltfData, indices: int | None, mode: int | None, vertices: int) -> Indices:
    """Returns the triangles (F, 3) of a primitive.

    Args:
        file: The file.
        indices: Accessor of its corners; None if the vertices themselves are the corners.
        mode: How corners follow one another; separate triangles by default.
        vertices: Number of its vertices.

    Raises:
        DataError: If a corner is no vertex, or the mode is unknown.
    """
    corners = np.arange(vertices) if indices is None else file.integers(indices)[:, 0]
    if len(corners) and int(corners.max()) >= vertices:
        raise file.wrong(f"a triangle has the vertex {int(corners.max())}; the mesh has {vertices}")
    if mode == _STRIP:
        faces = np.stack([corners[:-2], corners[1:-1], corners[2:]], axis=1)
        # Every second triangle of a strip turns the other way.
        faces[1::2] = faces[1::2, [1, 0, 2]]
        return faces
    if mode == _FAN:
        first = np.full(max(0, len(corners) - 2), corners[0] if len(corners) else 0)
        return np.stack([first, corners[1:-1], corners[2:]], axis=1)
    if mode not in (None, _TRIANGLES):
        raise file.wrong(f"a mesh has the mode {mode}, which the format does not know")
    if len(corners) % 3:
        raise file.wrong(
            f"a mesh has {len(corners)} triangle corners; they must be a multiple of 3"
        )
    return corners.reshape(-1, 3)
