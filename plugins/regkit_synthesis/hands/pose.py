"""Poses of a right hand with the joints of WebXR."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from regkit.geometry.rotation import conjugate, from_matrix, from_vector, product, to_matrix
from regkit.system.arrays import Array
from regkit_synthesis.motion.mending import interpolated

WRIST = "wrist"

_PARTS = ("metacarpal", "phalanx-proximal", "phalanx-intermediate", "phalanx-distal", "tip")

CHAINS = {
    "thumb": tuple(f"thumb-{part}" for part in _PARTS if part != "phalanx-intermediate"),
    **{
        finger: tuple(f"{finger}-finger-{part}" for part in _PARTS)
        for finger in ("index", "middle", "ring", "pinky")
    },
}
"""The WebXR joints of each finger, from the wrist outwards."""

PARENTS = {
    joint: parent
    for chain in CHAINS.values()
    for parent, joint in zip((WRIST, *chain), chain, strict=False)
}
"""Every joint but the wrist, and the one that it turns against."""

_OF_THUMB = np.array([joint in CHAINS["thumb"] for joint in PARENTS])


@dataclass(frozen=True)
class HandPose:
    """A right hand in its wrist's frame: x to the little finger, y out of the back, z backward.

    Attributes:
        origins: Position (3,) of each WebXR joint [m].
        joints: (24, 4) rotation of each of ``PARENTS`` against the joint before it.
    """

    origins: dict[str, Array]
    joints: Array

    @classmethod
    def of(cls, matrices: Mapping[str, Array]) -> HandPose:
        """The pose of a right hand whose joints are at ``T_world_joint`` (4, 4) [m], by name."""
        wrist = matrices[WRIST]
        turns = {
            joint: from_matrix(wrist[:3, :3].T @ matrix[:3, :3])
            for joint, matrix in matrices.items()
        }
        origins = {
            joint: wrist[:3, :3].T @ (matrix[:3, 3] - wrist[:3, 3])
            for joint, matrix in matrices.items()
        }
        joints = [
            product(conjugate(turns[parent]), turns[joint]) for joint, parent in PARENTS.items()
        ]
        return cls(origins, np.array(joints))

    def with_thumb_of(self, other: HandPose) -> HandPose:
        """The pose with the thumb turned as in another pose."""
        return self._with(np.where(_OF_THUMB[:, None], other.joints, self.joints))

    def with_thumb_lifted(self, angle: float) -> HandPose:
        """The pose with the thumb turned about its base, out of the palm, by ``angle`` [rad]."""
        base, tip = CHAINS["thumb"][0], CHAINS["thumb"][-1]
        axis = np.cross(self.origins[tip] - self.origins[base], [0.0, -1.0, 0.0])
        lift = from_vector(angle * axis / np.linalg.norm(axis))
        at_base = np.array([joint == base for joint in PARENTS])
        return self._with(np.where(at_base[:, None], product(lift, self.joints), self.joints))

    def with_fingers_towards(self, other: HandPose, share: float) -> HandPose:
        """The pose with the fingers, but not the thumb, turned part of the way to another pose.

        Args:
            other: The other pose.
            share: Which part of the way: 0 is this pose, 1 the other.
        """
        turned = interpolated(self.joints, other.joints, share)
        return self._with(np.where(_OF_THUMB[:, None], self.joints, turned))

    def rotations(self) -> dict[str, Array]:
        """``R_wrist_joint`` (3, 3) of every joint: -z along the bone, y out of the back."""
        return chained(self.joints)

    def _with(self, joints: Array) -> HandPose:
        """The same hand with its joints turned otherwise (24, 4)."""
        old, new = chained(self.joints), chained(joints)
        origins = {WRIST: self.origins[WRIST]}
        for joint, parent in PARENTS.items():
            bone = old[parent].T @ (self.origins[joint] - self.origins[parent])
            origins[joint] = origins[parent] + new[parent] @ bone
        return HandPose(origins, joints)


def chained(joints: Array) -> dict[str, Array]:
    """The rotations (3, 3) against the wrist, of rotations (24, 4) against the joint before."""
    rotations = {WRIST: np.eye(3)}
    for (joint, parent), matrix in zip(PARENTS.items(), to_matrix(joints), strict=True):
        rotations[joint] = rotations[parent] @ matrix
    return rotations
