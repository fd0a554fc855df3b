"""How the mesh of a hand is divided into segments."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from regkit.fitting.layout import Layout, SegmentFrame
from regkit.geometry.rigid import transformed
from regkit.geometry.rotation import rotation_between, vector_to_matrix
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array
from regkit_synthesis.bodies.landmarks import hand_landmarks
from regkit_synthesis.templates.straight import FORWARD, mesh_axes, unit

PALM = "palm"

FINGERS = ("thumb", "index", "middle", "ring", "little")
"""Finger k + 1 of the mesh is the k-th here."""

_JOINTS = dict.fromkeys(FINGERS, ("mcp", "pip", "dip", "tip")) | {
    "thumb": ("cmc", "mcp", "ip", "tip")
}


@dataclass(frozen=True)
class HandLayout(Layout):
    """How the mesh of a hand is divided into segments.

    Attributes:
        phalanges: (3,) each phalanx in the rest pose, from its joint to the next or the tip [m].
        bends: (3,) unit vector about which each phalanx bends in the rest pose.
    """

    phalanges: Mapping[str, Array]
    bends: Mapping[str, Array]


def hand_layout(mesh: SkinnedMesh) -> HandLayout:
    """Where the 16 segments lie in the mesh of a right hand, and how they are turned to rest.

    The frame's y axis goes from the wrist to the middle finger's knuckle, z out of the palm, x to
    the thumb. The fingers become straight and lie in the plane of the palm, splayed as the mesh's
    are. The thumb's metacarpal stays where it is; its two other joints are turned about their
    hinges until they are not bent, which leaves the sideways angles that every thumb has there.
    """
    positions = {name: landmark.position for name, landmark in hand_landmarks(mesh).items()}
    wrist = positions["wrist"]
    along = unit(positions["middle_mcp"] - wrist)
    across = positions["index_mcp"] - positions["little_mcp"]
    side = unit(across - (across @ along) * along)
    T_template_mesh = mesh_axes(np.column_stack([side, along, np.cross(side, along)]), wrist)
    owners = dict.fromkeys(mesh.labels, PALM)
    frames = {PALM: SegmentFrame(np.zeros(3), np.eye(3))}
    phalanges: dict[str, Array] = {}
    bends: dict[str, Array] = {}
    for number, finger in enumerate(FINGERS, start=1):
        joints = transformed(
            T_template_mesh, np.array([positions[f"{finger}_{joint}"] for joint in _JOINTS[finger]])
        )
        turn, direction = np.eye(3), joints[1] - joints[0]
        if finger != "thumb":
            direction = direction * [1.0, 1.0, 0.0]
        for part in (1, 2, 3):
            label, name = f"finger{number}-{part}.R", f"{finger}_{part}"
            bone = joints[part] - joints[part - 1]
            if finger != "thumb":
                turn = rotation_between(turn @ bone, direction) @ turn
                bend = unit(np.cross(direction, FORWARD))
            else:
                # A bone of the mesh bends about its own x axis.
                bend = turn @ T_template_mesh[:3, :3] @ mesh.rest[mesh.bone(label), :3, 0]
                turn = vector_to_matrix(-_bent(turn @ bone, direction, bend) * bend) @ turn
                direction = turn @ bone
            owners[label] = name
            frames[name] = SegmentFrame(joints[part - 1], turn)
            phalanges[name], bends[name] = turn @ bone, unit(bend)
    return HandLayout(T_template_mesh, owners, frames, phalanges, bends)


def _bent(bone: Array, straight: Array, axis: Array) -> float:
    """The angle about ``axis`` by which ``bone`` is bent out of ``straight`` [rad]."""
    return float(np.arctan2(bone @ np.cross(axis, straight), bone @ straight))
