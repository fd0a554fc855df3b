"""The two recordings that ship with regkit: a person who walks, and a hand that makes gestures."""

from __future__ import annotations

import numpy as np

from regkit_synthesis import assets
from regkit_synthesis.hands.gestures import Gestures
from regkit_synthesis.hands.shipped import iwer
from regkit_synthesis.recordings.hand_take import HandTake
from regkit_synthesis.recordings.person_take import PersonTake
from regkit_synthesis.recordings.recording import DepthRecording
from regkit_synthesis.recordings.scene import SR4000

_WALK = PersonTake("walk", heading=20.0, place=(-0.05, 0.76, 3.25))


def human_walk(seed: int) -> DepthRecording:
    """A person who walks towards the camera, turned a little to the side."""
    scene = _WALK.scene("human_walk", "the body", assets.average_human())
    random = np.random.default_rng([seed, 0])
    return scene.rendered(lambda frame: random)


def hand_gestures(seed: int) -> DepthRecording:
    """A right hand that points, pinches and relaxes while it turns before the camera."""
    take = HandTake(
        gestures=_gestures,
        poses="relaxed, point and pinch of iwer",
        frames=60,
        distance=0.43,
        sensor=SR4000,
    )
    scene = take.scene("hand_gestures", "the right hand", assets.average_hand())
    random = np.random.default_rng([seed, 1])
    return scene.rendered(lambda frame: random)


def _gestures() -> Gestures:
    relaxed, point, pinch = (iwer(name) for name in ("relaxed", "point", "pinch"))
    return Gestures(np.array([0.0, 0.65, 1.3, 1.95]), (relaxed, point, pinch, relaxed))
