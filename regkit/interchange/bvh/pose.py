"""The poses of a BVH motion: numbers of channels as rotations and positions of joints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from regkit.geometry.rotation import IDENTITY, from_vector, product, to_matrix
from regkit.interchange.bvh.hierarchy import CHANNELS, BvhJoint
from regkit.system.arrays import Array


@dataclass(frozen=True, eq=False)
class BvhPose:
    """The world transforms of all joints.

    Attributes:
        rotations: R_world_joint, (J, 3, 3); the identity at rest.
        positions: Positions in the world, (J, 3) [m].
    """

    rotations: Array
    positions: Array


def relative_motion(joints: Sequence[BvhJoint], frames: Array) -> tuple[Array, Array]:
    """Returns the joints' rotations (F, J, 4) and positions (F, J, 3) [m] relative to the parents.

    Args:
        joints: The joints (J), parents first.
        frames: Numbers of all channels (F, C), positions [m] and angles [deg].
    """
    count = len(frames)
    rotations = np.tile(IDENTITY, (count, len(joints), 1))
    positions = np.tile([joint.offset for joint in joints], (count, 1, 1))
    column = 0
    for index, joint in enumerate(joints):
        for channel in joint.channels:
            axis, numbers = CHANNELS.index(channel) % 3, frames[:, column]
            if channel.endswith("position"):
                positions[:, index, axis] = numbers
            else:
                rotation = from_vector(np.radians(numbers)[:, None] * np.eye(3)[axis])
                rotations[:, index] = product(rotations[:, index], rotation)
            column += 1
    return rotations, positions


def posed(joints: Sequence[BvhJoint], rotations: Array, positions: Array) -> BvhPose:
    """Returns the pose of rotations (J, 4) and positions (J, 3) [m] relative to the parents."""
    relative = to_matrix(rotations)
    pose = BvhPose(relative.copy(), positions.copy())
    for index, joint in enumerate(joints):
        if joint.parent >= 0:
            parent = pose.rotations[joint.parent]
            pose.rotations[index] = parent @ relative[index]
            pose.positions[index] = pose.positions[joint.parent] + parent @ positions[index]
    return pose
