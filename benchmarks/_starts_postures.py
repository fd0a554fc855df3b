"""Folded postures, drawn from ranges of joint angles: no motion is behind them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from regkit.system.arrays import Array
from regkit_synthesis.motion.keyframes import Keyframe, Keyframes

Range = tuple[float, float]

Ranges = tuple[Range, Range, Range]

NONE: Range = (0.0, 0.0)

TURNED: Range = (-20.0, 20.0)
"""Rotation of a thigh about its length [deg]."""


def _leg(hip: Range, knee: Range, ankle: Range, spread: Range = (0.0, 15.0)) -> dict[str, Ranges]:
    """Returns the ranges of a leg [deg]: flexions of its joints, and how far it is spread."""
    raised, bent = (-hip[1], -hip[0]), (-ankle[1], -ankle[0])
    return {
        "hip": (raised, spread, TURNED),
        "knee": (knee, NONE, NONE),
        "ankle": (bent, NONE, NONE),
    }


UPRIGHT: Range = (-5.0, 20.0)
"""Forward pitch of the pelvis [deg]."""

HEEL: Range = (-45.0, -20.0)
"""Flexion of an ankle whose toes point backward [deg]."""

SOLE: Range = (-10.0, 20.0)
"""Flexion of an ankle whose sole is on the ground [deg]."""

Posture = tuple[Range, Range, dict[str, Ranges], dict[str, Ranges]]

POSTURES: Mapping[str, Posture] = {
    "kneeling": (UPRIGHT, UPRIGHT, *2 * (_leg((-5, 30), (80, 115), HEEL),)),
    "on the heels": (UPRIGHT, (0, 40), *2 * (_leg((55, 100), (125, 150), HEEL),)),
    "on one knee": (
        UPRIGHT,
        UPRIGHT,
        _leg((70, 105), (75, 110), SOLE),
        _leg((-5, 25), (75, 110), HEEL),
    ),
    "on a chair": (UPRIGHT, (-5, 30), *2 * (_leg((65, 100), (55, 105), SOLE),)),
    "legs stretched": ((-20, 10), (0, 40), *2 * (_leg((65, 100), (0, 35), (-30, 0), (0, 30)),)),
    "cross-legged": ((-15, 10), (0, 40), *2 * (_leg((65, 100), (110, 145), HEEL, (20, 45)),)),
    "knees drawn up": ((-20, 10), (10, 50), *2 * (_leg((95, 120), (95, 140), SOLE),)),
    "squatting": ((10, 40), (0, 40), *2 * (_leg((95, 120), (105, 150), SOLE, (0, 30)),)),
    "bowing": ((50, 90), (20, 60), *2 * (_leg((85, 118), (120, 150), HEEL),)),
    "crouching": ((20, 60), (10, 60), *2 * (_leg((50, 95), (50, 95), SOLE),)),
    "on all fours": ((70, 95), (-10, 20), *2 * (_leg((75, 105), (75, 105), HEEL),)),
    "stooping": ((30, 60), (30, 75), *2 * (_leg((30, 70), (0, 40), SOLE),)),
    "curled up": ((70, 110), (20, 60), *2 * (_leg((80, 118), (80, 140), HEEL),)),
    "a leg raised": (
        UPRIGHT,
        UPRIGHT,
        _leg((55, 110), (0, 110), SOLE, (0, 30)),
        _leg((-10, 15), (0, 20), SOLE),
    ),
}
"""Pitch of the pelvis and flexion of the spine, and the left and right leg [deg], by name."""


def _arm(raised: Range, spread: Range, bent: Range) -> dict[str, Ranges]:
    """Returns the ranges of an arm [deg]: how far forward and sideways, and its elbow."""
    shoulder = (-raised[1], -raised[0]), spread, (-30.0, 30.0)
    return {"shoulder": shoulder, "elbow": ((-bent[1], -bent[0]), NONE, NONE)}


ARMS: Mapping[str, dict[str, Ranges]] = {
    "anywhere": _arm((-30, 150), (5, 60), (5, 120)),
    "hanging": _arm((-20, 20), (3, 15), (0, 40)),
    "before the body": _arm((10, 70), (0, 20), (60, 130)),
    "stretched": _arm((50, 120), (0, 20), (0, 40)),
}
"""Ranges of an arm [deg], by what it does."""

ALIKE = 8.0
"""Standard deviation of the angles of two sides that do the same [deg]."""

LARGEST = 9
"""Number of angles of a leg."""


def drawn_posture(name: str, random: np.random.Generator) -> Keyframes:
    """Returns a posture at rest.

    Legs and arms do nearly the same where they share their ranges.

    Args:
        name: Name of the posture.
        random: Source of the angles.
    """
    pelvis, spine, *legs = POSTURES[name]
    joints = {
        "pelvis": (random.uniform(*pelvis), 0.0, 0.0),
        "chest": (random.uniform(*spine), *random.normal(0.0, 8.0, size=2)),
        "head": (random.uniform(-30.0, 15.0), 0.0, random.uniform(-40.0, 40.0)),
    }
    sides = ("left", "right") if random.uniform() < 0.5 else ("right", "left")
    arms = [ARMS[name] for name in random.choice(list(ARMS), size=2)]
    if random.uniform() < 0.5:
        arms[1] = arms[0]
    for limbs in (legs, arms):
        shares = random.uniform(size=(2, LARGEST))
        if limbs[0] is limbs[1]:
            shares[1] = shares[0]
        for side, limb, share in zip(sides, limbs, shares, strict=True):
            joints |= _limb(side, limb, share, random)
    frames = tuple(Keyframe(time=time, joints=joints) for time in (0.0, 1.0))
    return Keyframes(frames=frames)


def _limb(
    side: str, ranges: Mapping[str, Ranges], shares: Array, random: np.random.Generator
) -> dict[str, tuple[float, float, float]]:
    """Returns the angles of a limb [deg], at shares (LARGEST,) of their ranges and shaken."""
    mirror = np.array([1.0, -1.0, -1.0] if side == "left" else [1.0, 1.0, 1.0])
    joints = {}
    for index, (joint, limits) in enumerate(ranges.items()):
        low, high = np.array(limits).T
        angles = low + shares[3 * index : 3 * index + 3] * (high - low)
        angles += np.where(low < high, random.normal(0.0, ALIKE, size=3), 0.0)
        x, y, z = mirror * np.clip(angles, low, high)
        joints[f"{side}_{joint}"] = (float(x), float(y), float(z))
    return joints
