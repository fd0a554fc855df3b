"""Rigid motions from pairs of correspondences and their common neighbours, in compiled loops."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled
from regkit_plugins.alignment_starts.features.compiled_consistency import Bits, Sides

MOST = 40
"""Greatest number of correspondences for one motion."""


@compiled
def motions(sides: Sides, pairs: Indices, graph: Bits, lever: float) -> Array:
    """Returns the motion of each pair and its common neighbours, (P, 3, 4).

    Args:
        sides: The correspondences.
        pairs: Pairs of them, (P, 2).
        graph: Which correspondences are consistent, in bits.
        lever: Lever at which a normal counts like a point [m].
    """
    found, members = np.empty((len(pairs), 3, 4)), np.empty(MOST, np.int64)
    for p in range(len(pairs)):
        members[0], members[1], count = pairs[p, 0], pairs[p, 1], 2
        for word in range(graph.shape[1]):
            both = graph[pairs[p, 0], word] & graph[pairs[p, 1], word]
            for bit in range(64):
                if both == 0 or count == MOST:
                    break
                if both & np.uint64(1):
                    members[count] = 64 * word + bit
                    count += 1
                both >>= np.uint64(1)
        found[p] = _motion(sides, members[:count], lever)
    return found


@compiled
def _motion(sides: Sides, members: Indices, lever: float) -> Array:
    """Returns the motion (3, 4) with the least squares of some correspondences."""
    here, there, moments = np.zeros(3), np.zeros(3), np.zeros((3, 3))
    for index in members:
        for i in range(3):
            here[i] += sides.source[index, i] / len(members)
            there[i] += sides.target[index, i] / len(members)
    for index in members:
        for i in range(3):
            arm = sides.source[index, i] - here[i]
            normal = lever * lever * sides.source_normals[index, i]
            for j in range(3):
                moments[i, j] += arm * (sides.target[index, j] - there[j])
                moments[i, j] += normal * sides.target_normals[index, j]
    motion = np.empty((3, 4))
    _set_rotation(moments, motion)
    for i in range(3):
        motion[i, 3] = there[i]
        for j in range(3):
            motion[i, 3] -= motion[i, j] * here[j]
    return motion


@compiled
def _set_rotation(moments: Array, motion: Array) -> None:
    """Sets the rotation of a motion (3, 4) that turns sources to targets with moments s t^T (3, 3).

    Its quaternion is the eigenvector of the greatest eigenvalue of Horn's matrix (Closed-form
    solution of absolute orientation using unit quaternions, 1987, section 4).
    """
    s, matrix = moments, np.empty((4, 4))
    matrix[0, 0] = s[0, 0] + s[1, 1] + s[2, 2]
    matrix[1, 1] = s[0, 0] - s[1, 1] - s[2, 2]
    matrix[2, 2] = s[1, 1] - s[0, 0] - s[2, 2]
    matrix[3, 3] = s[2, 2] - s[0, 0] - s[1, 1]
    matrix[0, 1] = matrix[1, 0] = s[1, 2] - s[2, 1]
    matrix[0, 2] = matrix[2, 0] = s[2, 0] - s[0, 2]
    matrix[0, 3] = matrix[3, 0] = s[0, 1] - s[1, 0]
    matrix[1, 2] = matrix[2, 1] = s[0, 1] + s[1, 0]
    matrix[1, 3] = matrix[3, 1] = s[2, 0] + s[0, 2]
    matrix[2, 3] = matrix[3, 2] = s[1, 2] + s[2, 1]
    _, vectors = np.linalg.eigh(matrix)
    w, x, y, z = vectors[0, 3], vectors[1, 3], vectors[2, 3], vectors[3, 3]
    motion[0, 0], motion[1, 1] = w * w + x * x - y * y - z * z, w * w - x * x + y * y - z * z
    motion[2, 2] = w * w - x * x - y * y + z * z
    motion[0, 1], motion[1, 0] = 2.0 * (x * y - w * z), 2.0 * (x * y + w * z)
    motion[0, 2], motion[2, 0] = 2.0 * (x * z + w * y), 2.0 * (x * z - w * y)
    motion[1, 2], motion[2, 1] = 2.0 * (y * z - w * x), 2.0 * (y * z + w * x)
