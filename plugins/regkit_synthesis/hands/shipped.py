"""The hand poses that ship with regkit."""

from __future__ import annotations

from regkit_synthesis.assets import ASSETS
from regkit_synthesis.hands.handywork import read_handywork
from regkit_synthesis.hands.iwer import read_iwer
from regkit_synthesis.hands.pose import HandPose


def iwer(name: str) -> HandPose:
    """The pose of this name that was recorded for iwer."""
    return read_iwer(ASSETS / "iwer" / f"{name}.js")


def handywork(name: str) -> HandPose:
    """The pose of this name that was recorded for handy-work."""
    return read_handywork(ASSETS / "handywork" / f"{name}.handpose")
