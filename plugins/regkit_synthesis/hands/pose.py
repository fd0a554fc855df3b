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
"""The WebXR joints of each finger, from the wrist to the tip."""

PARENTS = {
    joint: parent
    for chain in CHAINS.values()
    for parent, joint in zip((WRIST, *chain), chain, strict=False)
}
"""The parent of every joint except the wrist."""

_OF_THUMB = np.array([joint in CHAINS["thumb"] for joint in PARENTS])


@dataclass(frozen=True)
class HandPose:
    """A right hand in the wrist frame: x to the little finger, y out of the back, z backward.

    Attributes:
        origins: Position (3,) [m] of each WebXR joint.
        joints: Rotation of each joint in ``PARENTS`` relative to its parent, (24, 4).
    """

    origins: dict[str, Array]
    joints: Array

    @classmethod
    def of(cls, matrices: Mapping[str, Array]) -> HandPose:
        """Returns the pose of a right hand with joints at ``T_world_joint`` (4, 4) [m], by name."""
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
        """Returns the pose with the thumb of another pose."""
        return self._with(np.where(_OF_THUMB[:, None], other.joints, self.joints))

    def with_thumb_lifted(self, angle: float) -> HandPose:
        """Returns the pose with the thumb rotated out of the palm by ``angle`` [rad]."""
        base, tip = CHAINS["thumb"][0], CHAINS["thumb"][-1]
        axis = np.cross(self.origins[tip] - self.origins[base], [0.0, -1.0, 0.0])
        lift = from_vector(angle * axis / np.linalg.norm(axis))
        at_base = np.array([joint == base for joint in PARENTS])
        return self._with(np.where(at_base[:, None], product(lift, self.joints), self.joints))

    def with_fingers_towards(self, other: HandPose, share: float) -> HandPose:
        """Returns the pose with the fingers, except the thumb, interpolated to another pose.

        Args:
            other: The other pose.
            share: Fraction of the way from this pose (0) to the other (1).
        """
        turned = interpolated(self.joints, other.joints, share)
        return self._with(np.where(_OF_THUMB[:, None], self.joints, turned))

    def rotations(self) -> dict[str, Array]:
        """Returns ``R_wrist_joint`` (3, 3) by joint: -z along the bone, y out of the back."""
        return chained(self.joints)

    def _with(self, joints: Array) -> HandPose:
        """Returns the hand with other joint rotations (24, 4)."""
        old, new = chained(self.joints), chained(joints)
        origins = {WRIST: self.origins[WRIST]}
        for joint, parent in PARENTS.items():
            bone = old[parent].T @ (self.origins[joint] - self.origins[parent])
            origins[joint] = origins[parent] + new[parent] @ bone
        return HandPose(origins, joints)


def chained(joints: Array) -> dict[str, Array]:
    """Returns rotations (3, 3) relative to the wrist, of rotations (24, 4) relative to parents."""
    rotations = {WRIST: np.eye(3)}
    for (joint, parent), matrix in zip(PARENTS.items(), to_matrix(joints), strict=True):
        rotations[joint] = rotations[parent] @ matrix
    return rotations
