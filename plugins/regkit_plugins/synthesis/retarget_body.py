"""Recorded body motion on the bones of a mesh: every bone turns as its segment of the clip does."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.arrays import Array
from regkit.rotation import between, from_matrix, to_matrix
from regkit.skinned_mesh import SkinnedMesh
from regkit_plugins.synthesis.mending import interpolated
from regkit_plugins.synthesis.motion_clip import ClipPose

R_BODY_CLIP = np.array([[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
"""From the clip's axes (x forward, y up, z right) to the mesh's (x left, y backward, z up)."""

CLIP_LEG = 0.421546 + 0.409870
"""Length of the thigh and the shin of the clips' character [m], as in pybullet's humanoid.urdf."""

_DOWN = np.array([0.0, 0.0, -1.0])

_TRUNK = {
    "Hips": ("root", "root", 0.0),
    "LHipJoint": ("root", "root", 0.0),
    "RHipJoint": ("root", "root", 0.0),
    "LowerBack": ("root", "chest", 1.0 / 3.0),
    "Spine": ("root", "chest", 2.0 / 3.0),
    "Spine1": ("root", "chest", 1.0),
    "LeftShoulder": ("root", "chest", 1.0),
    "RightShoulder": ("root", "chest", 1.0),
    "Neck": ("chest", "neck", 1.0 / 3.0),
    "Neck1": ("chest", "neck", 2.0 / 3.0),
    "Head": ("chest", "neck", 1.0),
}
"""The two segments that a bone of the trunk lies between, and how far along; the character has one
joint where the mesh has three."""

_LIMBS = {
    "UpLeg": "hip",
    "Leg": "knee",
    "Foot": "ankle",
    "ToeBase": "ankle",
    "Arm": "shoulder",
    "ForeArm": "elbow",
    "Hand": "elbow",
    "FingerBase": "elbow",
    "HandFinger1": "elbow",
    "Thumb": "elbow",
}
"""The segment that each bone of a limb follows, both without their side."""


@dataclass(frozen=True)
class BodyMotion:
    """Turns poses of a clip into bone poses of a mesh whose bones are named as in CMU's recordings.

    Attributes:
        mesh: The body, at rest with its arms half down and its elbows bent.
        straight: (J, 3, 3) turns each bone from rest to where it points in the clip's zero pose.
        scale: Length of the mesh's legs over the clip's.
        hips: (3,) from the first bone's start to the middle of the hips at rest [m].
    """

    mesh: SkinnedMesh
    straight: Array
    scale: float
    hips: Array

    @classmethod
    def of(cls, mesh: SkinnedMesh) -> BodyMotion:
        """Measure a mesh."""
        hip, knee, ankle = (mesh.origin(f"Left{bone}") for bone in ("UpLeg", "Leg", "Foot"))
        leg = float(np.linalg.norm(knee - hip) + np.linalg.norm(ankle - knee))
        middle = (hip + mesh.origin("RightUpLeg")) / 2
        return cls(mesh, _straight(mesh), leg / CLIP_LEG, middle - mesh.rest[0, :3, 3])

    def bone_poses(self, pose: ClipPose) -> Array:
        """The bone poses ``T_world_bone`` (J, 4, 4) in the mesh's axes (x left, y back, z up)."""
        segments = {
            name: R_BODY_CLIP @ rotation @ R_BODY_CLIP.T
            for name, rotation in pose.rotations.items()
        }
        rotations = (
            np.array([_turned(label, segments) for label in self.mesh.labels]) @ self.straight
        )
        middle = self.scale * (R_BODY_CLIP @ pose.root)
        return self.mesh.turned(rotations, middle - rotations[0] @ self.hips)


def _turned(label: str, segments: dict[str, Array]) -> Array:
    """The rotation (3, 3) of the bone named ``label``, from that of the segments."""
    if label in _TRUNK:
        begin, end, share = _TRUNK[label]
        start, goal = from_matrix(segments[begin]), from_matrix(segments[end])
        return to_matrix(interpolated(start, goal, share))
    side, bone = _sided(label)
    return segments[f"{side}_{_LIMBS[bone]}"]


def _sided(label: str) -> tuple[str, str]:
    """The side and the rest of a bone's name: ``LeftFoot`` and ``LThumb`` are both left."""
    side = "left" if label.startswith("L") else "right"
    for prefix in ("Left", "Right", "L", "R"):
        if label.startswith(prefix):
            return side, label.removeprefix(prefix)
    raise ValueError(f"{label!r} is no bone of a limb")


def _straight(mesh: SkinnedMesh) -> Array:
    """What turns each bone (J, 3, 3) from rest to the clip's zero pose: arms and legs hang down.

    From the shoulder outwards every bone is turned with the one before it and then, the shortest
    way, downwards: so the elbow bends about its own axis, and the forearm is not twisted.
    """
    turns = np.tile(np.eye(3), (len(mesh.labels), 1, 1))
    for side in ("Left", "Right"):
        for upper, lower, end in (("Arm", "ForeArm", "Hand"), ("UpLeg", "Leg", "Foot")):
            first = between(mesh.origin(side + lower) - mesh.origin(side + upper), _DOWN)
            forearm = first @ (mesh.origin(side + end) - mesh.origin(side + lower))
            turns[mesh.bone(side + upper)] = first
            turns[mesh.bone(side + lower)] = between(forearm, _DOWN) @ first
        # The sole stays level: the foot only turns about the vertical until it points forward.
        foot = (mesh.origin(side + "ToeBase") - mesh.origin(side + "Foot")) * [1.0, 1.0, 0.0]
        for bone in ("Foot", "ToeBase"):
            turns[mesh.bone(side + bone)] = between(foot, np.array([0.0, -1.0, 0.0]))
        hand = turns[mesh.bone(side + "ForeArm")]
        for bone in (side + "Hand", side + "FingerBase", side + "HandFinger1", side[0] + "Thumb"):
            turns[mesh.bone(bone)] = hand
    return turns
