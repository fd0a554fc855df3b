"""The poses of a BVH motion: numbers of channels as rotations and positions of joints."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
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


def relative_rotations(joints: Sequence[BvhJoint], frames: Array) -> Array:
    """Returns the joints' rotations relative to their parents, unit quaternions (F, J, 4).

    Args:
        joints: The joints (J), parents first.
        frames: Numbers of all channels (F, C), positions [m] and angles [deg].
    """
    rotations = np.tile(IDENTITY, (len(frames), len(joints), 1))
    for index, channel, numbers in _columns(joints, frames):
        if not channel.endswith("position"):
            axis = np.eye(3)[CHANNELS.index(channel) % 3]
            rotation = from_vector(np.radians(numbers)[:, None] * axis)
            rotations[:, index] = product(rotations[:, index], rotation)
    return rotations


def relative_positions(joints: Sequence[BvhJoint], frames: Array) -> Array:
    """Returns the joints' positions relative to their parents, (F, J, 3) [m].

    Args:
        joints: The joints (J), parents first.
        frames: Numbers of all channels (F, C), positions [m] and angles [deg].
    """
    positions = np.tile([joint.offset for joint in joints], (len(frames), 1, 1))
    for index, channel, numbers in _columns(joints, frames):
        if channel.endswith("position"):
            positions[:, index, CHANNELS.index(channel)] = numbers
    return positions


def _columns(joints: Sequence[BvhJoint], frames: Array) -> Iterator[tuple[int, str, Array]]:
    """Yields the index of the joint, the name and the numbers (F,) of every channel."""
    channels = [(index, one) for index, joint in enumerate(joints) for one in joint.channels]
    for (index, channel), numbers in zip(channels, frames.T, strict=True):
        yield index, channel, numbers


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
