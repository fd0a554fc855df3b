"""The meshes, clips and hand poses that ship with regkit, read and mended."""

from __future__ import annotations

from math import radians
from pathlib import Path

from regkit.skinned_mesh import SkinnedMesh
from regkit_plugins.synthesis.hand_poses import HandPose
from regkit_plugins.synthesis.handywork import read_handywork
from regkit_plugins.synthesis.iwer import read_iwer
from regkit_plugins.synthesis.motion_clip import MotionClip

ASSETS = Path(__file__).resolve().parent.parent / "assets"

_BRIDGES = {"walk": 18, "run": 11}
"""The row after which a clip does not quite go on: half a cycle meets its mirror image there."""

_ARMS_OUT = {"punch": radians(25.0), "kick": radians(15.0)}
"""How far the arms are turned out to keep them out of the trunk [rad]."""


def average_human() -> SkinnedMesh:
    """The body of average proportions."""
    return SkinnedMesh.read(ASSETS / "anny" / "body.npz")


def small_human() -> SkinnedMesh:
    """A small body."""
    return average_human().reshaped(ASSETS / "anny" / "body_small.npz")


def average_hand() -> SkinnedMesh:
    """The right hand of the body of average proportions."""
    return SkinnedMesh.read(ASSETS / "anny" / "hand_right.npz")


def slim_hand() -> SkinnedMesh:
    """A slim right hand, a little longer."""
    return average_hand().reshaped(ASSETS / "anny" / "hand_right_slim.npz")


def clip(name: str) -> MotionClip:
    """The clip of this name, without its defects."""
    found = MotionClip.read(ASSETS / "humanoid_pybullet" / f"humanoid3d_{name}.txt")
    if name in _BRIDGES:
        found = found.bridged(_BRIDGES[name])
    if name in _ARMS_OUT:
        found = found.with_arms_turned_out(_ARMS_OUT[name])
    if name == "kick":
        # While the leg is up, hips and chest shake against each other from row to row.
        found = found.smoothed()
    return found


def iwer(name: str) -> HandPose:
    """The pose of this name that was recorded for iwer."""
    return read_iwer(ASSETS / "iwer" / f"{name}.js")


def handywork(name: str) -> HandPose:
    """The pose of this name that was recorded for handy-work."""
    return read_handywork(ASSETS / "handywork" / f"{name}.handpose")
