"""Bone frames with y along the bone, for rigs with other conventions."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import rotation_between
from regkit.system.arrays import Array

CANCELLED = 0.2
"""A bone with several children has no direction if the length of their mean offset, relative to
the sum of their lengths, is below this."""


def along_bones(origins: Array, axes: Array, parents: Sequence[int]) -> Array:
    """Returns ``T_body_bone`` (J, 4, 4) with y along the bone, by the smallest rotations.

    A bone points to its child, or to the mean of several children. Without children, or with
    children on all sides, it has the direction of its parent; a single bone keeps its own.

    Args:
        origins: Origins of the bones, (J, 3) [m].
        axes: Rotations of the bones in the rig, (J, 3, 3).
        parents: Index of each bone's parent, (J,), parents before children; -1 for none.
    """
    frames = rigid(axes, origins)
    for bone, parent in enumerate(parents):
        offsets = [
            origins[child] - origins[bone] for child, above in enumerate(parents) if above == bone
        ]
        lengths = [float(np.linalg.norm(offset)) for offset in offsets]
        total = np.sum(offsets, axis=0) if offsets else np.zeros(3)
        if np.linalg.norm(total) > max(CANCELLED * sum(lengths), 1e-9):
            along = total
        elif parent >= 0:
            along = frames[parent, :3, 1]
        else:
            continue
        frames[bone, :3, :3] = rotation_between(axes[bone, :, 1], along) @ axes[bone]
    return frames


def nearest_rotations(matrices: Array) -> Array:
    """Returns the nearest rotation (J, 3, 3) to each matrix (J, 3, 3), also if scaled or mirrored.

    Source: Umeyama, Least-squares estimation of transformation parameters, 1991, eq. 40.
    """
    left, _, right = np.linalg.svd(matrices)
    signs = np.ones((len(matrices), 1, 3))
    signs[:, 0, 2] = np.linalg.det(left @ right)
    return np.asarray((left * signs) @ right)
