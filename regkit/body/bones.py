"""The lines that pictures draw for a skeleton."""

from __future__ import annotations

import numpy as np

from regkit.body.body import Body
from regkit.system.arrays import Array, Indices


def bones_of(body: Body) -> Indices:
    """Returns the ends of each bone as indices of ``bone_ends``, (B, 2).

    A bone joins each segment's origin with its parent's and with its markers. Where a free joint is
    between them, as in bodies beside each other, there is none.
    """
    bones, count = body.skeleton, len(body.skeleton.names)
    joints = [
        (parent, one)
        for one, (parent, name) in enumerate(zip(bones.parents.tolist(), bones.names, strict=True))
        if parent >= 0 and not bones.is_free(name)
    ]
    tips = [(one, count + marker) for marker, one in enumerate(body.markers.segments)]
    return np.array([*joints, *tips], dtype=np.intp).reshape(-1, 2)


def bone_ends(body: Body, transforms: Array) -> Array:
    """Returns the segments' origins, then the markers, (S + M, 3) [m].

    Args:
        body: The body.
        transforms: T_world_segment, (S, 4, 4).
    """
    return np.concatenate([transforms[:, :3, 3], body.markers.place(transforms)])
