"""Retargeting of recorded hand poses to the bones of a mesh, with the directions of the joints."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from regkit.geometry.rigid import rigid
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array
from regkit_synthesis.hands.pose import CHAINS, HandPose

_R_JOINT_BONE = np.array([[-1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, -1.0, 0.0]])
"""From the axes of a bone of a right finger (x to the thumb's side, y along it, z out of the palm)
to those of a WebXR joint (x to the little finger, y out of the back of the hand, z backward)."""


@dataclass(frozen=True)
class HandRetarget:
    """Converts WebXR poses of a right hand to bone poses of a mesh.

    Attributes:
        mesh: The mesh of a right hand.
        R_palm_wrist: Rotation from the WebXR wrist to the recorded palm, (3, 3).
        T_body_palm: The palm of the mesh at rest, (4, 4): its origin is the wrist, x points from
            the index to the little finger, y out of the back of the hand, z backward.
    """

    mesh: SkinnedMesh
    R_palm_wrist: Array
    T_body_palm: Array

    @classmethod
    def of(cls, mesh: SkinnedMesh, pose: HandPose) -> HandRetarget:
        """Returns the retargeting from a recorded hand, with the same palm in all poses."""
        recorded = _palm(
            pose.origins["wrist"],
            pose.origins["index-finger-phalanx-proximal"],
            pose.origins["middle-finger-phalanx-proximal"],
            pose.origins["pinky-finger-phalanx-proximal"],
        )
        wrist = mesh.origin("wrist.R")
        knuckles = (mesh.origin(f"finger{finger}-1.R") for finger in (2, 3, 5))
        return cls(mesh, recorded.T, rigid(_palm(wrist, *knuckles), wrist))

    def bone_poses(self, rotations: Mapping[str, Array], T_world_palm: Array) -> Array:
        """Returns the bone poses ``T_world_bone`` (J, 4, 4).

        Args:
            rotations: ``R_wrist_joint`` (3, 3) of each WebXR joint.
            T_world_palm: The palm in the world, (4, 4) [m].
        """
        R_world_palm, R_body_palm = T_world_palm[:3, :3], self.T_body_palm[:3, :3]
        turns = np.tile(R_world_palm @ R_body_palm.T, (len(self.mesh.labels), 1, 1))
        for number, (finger, joints) in enumerate(CHAINS.items(), start=1):
            # The metacarpals of the fingers are fixed to the palm, and tips are not bones.
            moving = joints[:-1] if finger == "thumb" else joints[1:-1]
            for part, joint in enumerate(moving, start=1):
                bone = self.mesh.bone(f"finger{number}-{part}.R")
                R_palm_bone = self.R_palm_wrist @ rotations[joint] @ _R_JOINT_BONE
                turns[bone] = R_world_palm @ R_palm_bone @ self.mesh.rest[bone, :3, :3].T
        return self.mesh.rotated(turns, T_world_palm[:3, 3])


def _palm(wrist: Array, index: Array, middle: Array, little: Array) -> Array:
    """Returns the axes of a palm, columns of (3, 3), from the wrist and three knuckles (3,)."""
    backward = wrist - middle
    backward = backward / np.linalg.norm(backward)
    across = little - index
    across = across - (across @ backward) * backward
    across = across / np.linalg.norm(across)
    return np.column_stack([across, np.cross(backward, across), backward])
