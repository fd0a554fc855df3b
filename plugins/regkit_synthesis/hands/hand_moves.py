"""What the hands of the suite do, from pose to pose."""

from __future__ import annotations

from math import radians

import numpy as np

from regkit_synthesis.hands.gestures import Gestures
from regkit_synthesis.hands.pose import HandPose
from regkit_synthesis.hands.shipped import handywork, iwer

_OPENING = 0.12
"""How far fingers of handy-work are opened towards its flat hand: the mesh's proximal phalanges are
shorter than the recorded ones, and its fingertips would go into the palm."""

_LIFT, _PINCH_LIFT = radians(20.0), radians(8.0)
"""The mesh's thumb begins 2 cm nearer to the back of the hand than the recorded ones. Where it lies
across the fingers, or meets the index finger, it is lifted to be as far from them as theirs."""


def gestures() -> Gestures:
    """A relaxed hand that points, pinches and relaxes."""
    relaxed, point = iwer("relaxed"), iwer("point")
    pinch = iwer("pinch").with_thumb_lifted(_PINCH_LIFT)
    return Gestures(np.array([0.0, 0.75, 1.5, 2.25]), (relaxed, point, pinch, relaxed))


def fists() -> Gestures:
    """An open hand that twice becomes a fist."""
    opened = handywork("flat").with_thumb_of(handywork("vulcan"))
    fist = _bent("fist").with_thumb_lifted(_LIFT)
    # The thumb closes last and opens first: otherwise it would go through the index finger.
    closed = (fist.with_thumb_of(opened), fist, fist.with_thumb_of(opened))
    times = np.array([0.0, 0.4, 0.7, 1.0, 1.4, 1.8, 2.1, 2.4, 2.8])
    return Gestures(times, (opened, *closed, opened, *closed, opened))


def signs() -> Gestures:
    """A relaxed hand that makes four signs."""
    relax, vulcan = handywork("relax"), handywork("vulcan")
    shaka, point = _bent("shaka"), _bent("point")
    horns = _bent("horns").with_thumb_lifted(_LIFT)
    # The thumb comes over the bent fingers last, and leaves them first.
    over = (horns.with_thumb_of(relax), horns, horns.with_thumb_of(shaka))
    times = np.array([0.0, 0.4, 0.7, 1.0, 1.4, 2.1, 2.8])
    return Gestures(times, (relax, *over, shaka, vulcan, point))


def _bent(name: str) -> HandPose:
    """A pose of handy-work with bent fingers, opened a little."""
    return handywork(name).with_fingers_towards(handywork("flat"), _OPENING)
