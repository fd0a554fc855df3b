"""Recorded hand poses on the bones of a mesh: every finger bone points as its WebXR joint does."""

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
    """Turns WebXR poses of a right hand into bone poses of a mesh.

    Attributes:
        mesh: A right hand.
        R_palm_wrist: (3, 3) turns the axes of the WebXR wrist into those of the recorded palm.
        T_body_palm: (4, 4) where the mesh's palm lies at rest: its origin is the wrist, x points
            from the index to the little finger, y out of the back of the hand, z backward.
    """

    mesh: SkinnedMesh
    R_palm_wrist: Array
    T_body_palm: Array

    @classmethod
    def of(cls, mesh: SkinnedMesh, pose: HandPose) -> HandRetarget:
        """Measure a mesh and a recorded hand, whose palm is the same in all poses."""
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
        """The bone poses ``T_world_bone`` (J, 4, 4).

        Args:
            rotations: Rotation (3, 3) ``R_wrist_joint`` of each WebXR joint.
            T_world_palm: (4, 4) where the palm is [m].
        """
        R_world_palm, R_body_palm = T_world_palm[:3, :3], self.T_body_palm[:3, :3]
        turns = np.tile(R_world_palm @ R_body_palm.T, (len(self.mesh.labels), 1, 1))
        for number, (finger, joints) in enumerate(CHAINS.items(), start=1):
            # The metacarpals of the fingers stay in the palm, and a tip is no bone.
            moving = joints[:-1] if finger == "thumb" else joints[1:-1]
            for part, joint in enumerate(moving, start=1):
                bone = self.mesh.bone(f"finger{number}-{part}.R")
                R_palm_bone = self.R_palm_wrist @ rotations[joint] @ _R_JOINT_BONE
                turns[bone] = R_world_palm @ R_palm_bone @ self.mesh.rest[bone, :3, :3].T
        return self.mesh.rotated(turns, T_world_palm[:3, 3])


def _palm(wrist: Array, index: Array, middle: Array, little: Array) -> Array:
    """The axes (3, 3) of a palm, as columns, from the wrist and three knuckles (3,)."""
    backward = wrist - middle
    backward = backward / np.linalg.norm(backward)
    across = little - index
    across = across - (across @ backward) * backward
    across = across / np.linalg.norm(across)
    return np.column_stack([across, np.cross(backward, across), backward])
