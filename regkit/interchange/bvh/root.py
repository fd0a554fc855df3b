"""The root of a BVH skeleton, which may be below reference joints."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from regkit.interchange.bvh.bvh import Bvh
from regkit.interchange.bvh.hierarchy import children_of
from regkit.system.arrays import Array
from regkit.system.notes import note

STILL = 1e-3
"""Motion of a joint that counts as none, relative to the skeleton's extent."""


@dataclass(frozen=True)
class BvhRoot:
    """The root of a skeleton.

    Attributes:
        members: Indices of the root and all joints below it, the root first.
        axes: ``R_file_root``, (3, 3): the rotation of the reference joints above it.
    """

    members: tuple[int, ...]
    axes: Array

    @classmethod
    def of(cls, motion: Bvh, path: Path) -> BvhRoot:
        """Returns the root, which is the hips if they move below a reference joint.

        Programs put a reference, such as the floor's origin, above the hips. A template has one
        free joint, its root, so the joint that moves becomes the root.

        Args:
            motion: The motion.
            path: The file, for notes.
        """
        children = children_of(motion.joints)
        root, axes = 0, np.eye(3)
        # Beside the hips a reference has at most props and markers, no limbs.
        while len(limbs := [child for child in children[root] if children[child]]) == 1:
            if movement(motion, limbs[0]) <= STILL:
                break
            axes = axes @ _steady(motion.rotations(root))
            root = limbs[0]
        members = [root]
        for index in members:
            members += children[index]
        if root:
            left_out = len(motion.joints) - len(members)
            note(
                f"'{motion.names[root]}' moves below '{motion.names[0]}', and is the root; joints "
                f"left out: {left_out}",
                place=path,
            )
        return cls(tuple(sorted(members)), axes)


def movement(motion: Bvh, joint: int) -> float:
    """Returns how far a joint moves relative to its parent, in units of the skeleton's extent."""
    places = motion.offsets(joint)
    extent = float(np.ptp(motion.rest_positions, axis=0).max())
    moved = float(np.ptp(places, axis=0).max(initial=0.0)) if len(places) else 0.0
    return moved / extent if extent > 0.0 else 0.0


def _steady(rotations: Array) -> Array:
    """Returns the rotation (3, 3) if all (F, 3, 3) are equal, or else the identity."""
    if len(rotations) and np.abs(rotations - rotations[0]).max() < STILL:
        return np.asarray(rotations[0])
    return np.eye(3)
