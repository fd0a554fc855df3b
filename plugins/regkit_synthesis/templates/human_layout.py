"""How the human mesh is divided into segments, and first guesses of their capsules."""

from __future__ import annotations

import numpy as np

from regkit.fitting.layout import Layout, SegmentFrame
from regkit.geometry.rigid import transformed
from regkit.geometry.rotation import rotation_between
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit_synthesis.templates.capsules import Piece
from regkit_synthesis.templates.straight import (
    DOWN,
    FORWARD,
    LEFT,
    aligned,
    mesh_axes,
    unit,
)

BONES = {
    "pelvis": ("Hips", "LHipJoint", "RHipJoint", "LowerBack"),
    "chest": ("Spine", "Spine1", "LeftShoulder", "RightShoulder"),
    "head": ("Neck", "Neck1", "Head"),
    "left_upper_arm": ("LeftArm",),
    "left_forearm": ("LeftForeArm",),
    "left_hand": ("LeftHand", "LThumb", "LeftFingerBase", "LeftHandFinger1"),
    "left_thigh": ("LeftUpLeg",),
    "left_shin": ("LeftLeg",),
    "left_foot": ("LeftFoot", "LeftToeBase"),
}
"""The bones of each segment of the middle and the left; its joint is where the first one starts."""

PARENTS = {
    "pelvis": None,
    "chest": "pelvis",
    "head": "chest",
    "left_upper_arm": "chest",
    "left_forearm": "left_upper_arm",
    "left_hand": "left_forearm",
    "left_thigh": "pelvis",
    "left_shin": "left_thigh",
    "left_foot": "left_shin",
}

MARKERS = {
    "pelvis": "pelvis",
    "spine": "chest",
    "neck": "chest",
    "head": "head",
    "left_shoulder": "left_upper_arm",
    "left_elbow": "left_forearm",
    "left_wrist": "left_hand",
    "left_hand": "left_hand",
    "left_hip": "left_thigh",
    "left_knee": "left_shin",
    "left_ankle": "left_foot",
    "left_foot": "left_foot",
}
"""The segment that carries each landmark of the mesh."""

KINECT = {
    "pelvis_kinect": ("pelvis", (0.0, 0.09, -0.01)),
    "spine_kinect": ("spine", (0.0, -0.06, -0.04)),
    "left_foot_kinect": ("left_foot", (0.0, 0.0, -0.10)),
}
"""Where the first Kinect's own tracker has joints that are not the anatomical ones: from which
landmark, and how far [m]. Measured on two people of UTD-MHAD, and rounded to a centimetre; what
was found on the one differs by 4 cm at most from what was found on the other."""

BALLS = {
    "pelvis": (2, 2),
    "chest": (4, 2),
    "head": (0, 4),
    "left_upper_arm": (0, 3),
    "left_forearm": (0, 3),
    "left_hand": (0, 2),
    "left_thigh": (0, 4),
    "left_shin": (0, 4),
    "left_foot": (0, 3),
}
"""How many pairs and how many single Gaussians a segment has in the SoG: with both sides, 58."""

PIECES = {
    "pelvis": (
        Piece((0.08, 0.0, 0.0), (-0.08, 0.0, 0.0), 0.09, "across"),
        Piece((0.06, 0.14, 0.02), (-0.06, 0.14, 0.02), 0.1, "across"),
        Piece((0.07, 0.02, -0.05), (0.07, 0.1, -0.03), 0.08, "pair"),
    ),
    "chest": (
        Piece((0.05, 0.03, 0.03), (-0.05, 0.03, 0.03), 0.1, "across"),
        Piece((0.06, 0.12, 0.04), (-0.06, 0.12, 0.04), 0.1, "across"),
        Piece((0.07, 0.18, 0.0), (-0.07, 0.18, 0.0), 0.1, "across"),
        Piece((0.06, 0.14, 0.08), (0.08, 0.12, 0.08), 0.06, "pair"),
        Piece((0.03, 0.27, 0.01), (0.14, 0.21, 0.01), 0.06, "pair"),
    ),
    "head": (
        Piece((0.0, 0.0, 0.0), (0.0, 0.09, 0.03), 0.06, "middle"),
        Piece((0.0, 0.17, -0.02), (0.0, 0.17, 0.06), 0.08, "middle"),
        Piece((0.0, 0.1, 0.08), (0.0, 0.15, 0.09), 0.05, "middle"),
        Piece((0.03, 0.12, 0.05), (-0.03, 0.12, 0.05), 0.06, "across"),
    ),
    "left_upper_arm": (Piece((0.0, -0.02, 0.0), (0.0, -0.25, 0.0), 0.045),),
    "left_forearm": (Piece((0.0, -0.02, 0.0), (0.0, -0.22, 0.0), 0.035),),
    "left_hand": (
        Piece((0.0, -0.03, 0.02), (0.0, -0.16, 0.02), 0.015),
        Piece((0.0, -0.03, -0.01), (0.0, -0.15, -0.02), 0.015),
        Piece((0.0, -0.02, 0.03), (0.0, -0.08, 0.06), 0.012),
    ),
    "left_thigh": (
        Piece((0.01, -0.04, -0.01), (0.0, -0.37, 0.0), 0.08),
        Piece((0.0, -0.1, 0.02), (0.0, -0.2, 0.02), 0.07),
    ),
    "left_shin": (
        Piece((0.0, -0.02, 0.0), (0.0, -0.38, 0.0), 0.045),
        Piece((0.0, -0.1, -0.02), (0.0, -0.2, -0.02), 0.045),
    ),
    "left_foot": (
        Piece((0.0, 0.0, -0.01), (0.0, -0.04, -0.03), 0.035),
        Piece((0.0, -0.02, 0.03), (0.0, -0.05, 0.14), 0.03),
        Piece((-0.02, -0.05, 0.12), (-0.02, -0.05, 0.17), 0.02),
        Piece((0.03, -0.05, 0.1), (0.03, -0.05, 0.15), 0.02),
    ),
}
"""First guesses in the segments' frames [m]."""

_AXES = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""The template's axes (x left, y up, z forward) in the mesh's (x left, y back, z up): columns."""


def human_layout(mesh: SkinnedMesh) -> Layout:
    """Where the 15 segments lie in the mesh, and how they are turned into the rest pose.

    The trunk stays as it is; arms and legs become straight and hang down. The upper arm and the
    forearm are turned until the axis about which the mesh's elbow is bent points to the side. The
    foot stays level and only turns until it points forward.
    """
    hips = (mesh.origin("LeftUpLeg") + mesh.origin("RightUpLeg")) / 2.0
    T_template_mesh = mesh_axes(_AXES, hips)
    places = transformed(T_template_mesh, mesh.rest[:, :3, 3])
    at = dict(zip(mesh.labels, places, strict=True))
    turns = {name: np.eye(3) for name in ("pelvis", "chest", "head")}
    for side, prefix in (("left", "Left"), ("right", "Right")):
        shoulder, elbow, wrist = (at[prefix + bone] for bone in ("Arm", "ForeArm", "Hand"))
        upper, fore = unit(elbow - shoulder), unit(wrist - elbow)
        bend = unit(np.cross(upper, fore))
        turns[f"{side}_upper_arm"] = aligned(upper, bend, DOWN, -LEFT)
        turns[f"{side}_forearm"] = turns[f"{side}_hand"] = aligned(fore, bend, DOWN, -LEFT)
        hip, knee, ankle = (at[prefix + bone] for bone in ("UpLeg", "Leg", "Foot"))
        thigh = rotation_between(knee - hip, DOWN)
        turns[f"{side}_thigh"] = thigh
        turns[f"{side}_shin"] = rotation_between(thigh @ (ankle - knee), DOWN) @ thigh
        foot = (at[prefix + "ToeBase"] - ankle) * [1.0, 0.0, 1.0]
        turns[f"{side}_foot"] = rotation_between(foot, FORWARD)
    owners: dict[str, str] = {}
    frames: dict[str, SegmentFrame] = {}
    for name, bones in BONES.items():
        for segment, own in ((name, bones), (name.replace("left", "right"), _mirrored(bones))):
            owners |= dict.fromkeys(own, segment)
            frames[segment] = SegmentFrame(at[own[0]], turns[segment])
    frames["pelvis"] = SegmentFrame(np.zeros(3), np.eye(3))
    return Layout(T_template_mesh, owners, frames)


def _mirrored(bones: tuple[str, ...]) -> tuple[str, ...]:
    """The right bones of left ones; those of the middle are their own mirror image."""
    swapped = [
        bone.replace("Left", "Right") if "Left" in bone else f"R{bone[1:]}" for bone in bones
    ]
    middle = ("Hips", "LowerBack", "Spine", "Spine1", "Neck", "Neck1", "Head")
    return tuple(
        bone if bone in middle or bone.startswith("R") else other
        for bone, other in zip(bones, swapped, strict=True)
    )
