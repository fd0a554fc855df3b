"""Frames of bones whose y axis points along the bone, for rigs whose axes point elsewhere."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import rotation_between
from regkit.system.arrays import Array

CANCELLED = 0.2
"""Ways to several children whose mean is shorter than this part of their lengths point nowhere."""


def along_bones(origins: Array, axes: Array, parents: Sequence[int]) -> Array:
    """``T_body_bone`` (J, 4, 4) with y along the bone, turned as little as can be.

    A bone points to its child, or to the middle of several; without one, or between children on
    all sides, it points where its parent does, and a single bone as it did.

    Args:
        origins: (J, 3) where the bones start [m].
        axes: (J, 3, 3) the rig's own rotations of the bones.
        parents: (J,) index of each bone's parent, which stands before it; -1 for none.
    """
    frames = rigid(axes, origins)
    for bone, parent in enumerate(parents):
        ways = [
            origins[child] - origins[bone] for child, above in enumerate(parents) if above == bone
        ]
        lengths = [float(np.linalg.norm(way)) for way in ways]
        mean = np.sum(ways, axis=0) if ways else np.zeros(3)
        if np.linalg.norm(mean) > max(CANCELLED * sum(lengths), 1e-9):
            along = mean
        elif parent >= 0:
            along = frames[parent, :3, 1]
        else:
            continue
        frames[bone, :3, :3] = rotation_between(axes[bone, :, 1], along) @ axes[bone]
    return frames


def nearest_rotations(matrices: Array) -> Array:
    """The rotation (J, 3, 3) nearest to each matrix (J, 3, 3), scaled or mirrored as it may be.

    Source: Umeyama, Least-squares estimation of transformation parameters, 1991, eq. 40.
    """
    left, _, right = np.linalg.svd(matrices)
    signs = np.ones((len(matrices), 1, 3))
    signs[:, 0, 2] = np.linalg.det(left @ right)
    return np.asarray((left * signs) @ right)
