"""The YAML form of hand motions."""

from __future__ import annotations

from itertools import pairwise
from math import radians
from typing import Annotated, Literal

import numpy as np
from pydantic import AfterValidator, Field, model_validator

from regkit.config.document import Document
from regkit.config.model import InputPath, Model
from regkit.config.quantities import Angle, Duration, Share, Turn
from regkit_synthesis.assets import ASSETS
from regkit_synthesis.hands.gestures import Gestures
from regkit_synthesis.hands.motion import HandMotion
from regkit_synthesis.hands.pose import HandPose
from regkit_synthesis.hands.shipped import PoseName, shipped_pose
from regkit_synthesis.motion.shipped import Shelf

GESTURES = Shelf("gestures", ASSETS / "gestures", "", ".yaml")
"""Gestures made for regkit."""

_FLAT = "handywork/flat"


class TimedPose(Model):
    """A pose at a time."""

    time: Duration
    """Time [s]."""

    pose: PoseName
    """Name of a shipped pose."""

    opened: Share = 0.0
    """Fraction by which the fingers, except the thumb, are opened towards a flat hand."""

    thumb: PoseName | None = None
    """Name of another pose for the thumb; by default the same."""

    thumb_lift_deg: Turn = 0.0
    """Rotation of the thumb about its base, out of the palm [deg]."""

    def hand(self) -> HandPose:
        """Returns the pose of the hand."""
        pose = shipped_pose(self.pose)
        if self.opened:
            pose = pose.with_fingers_towards(shipped_pose(_FLAT), self.opened)
        if self.thumb is not None:
            pose = pose.with_thumb_of(shipped_pose(self.thumb))
        return pose.with_thumb_lifted(radians(self.thumb_lift_deg)) if self.thumb_lift_deg else pose


def _increasing(poses: tuple[TimedPose, ...]) -> tuple[TimedPose, ...]:
    times = [pose.time for pose in poses]
    if any(later <= earlier for earlier, later in pairwise(times)):
        raise ValueError(f"the times of the poses must increase; they are {times}")
    return poses


TimedPoses = Annotated[tuple[TimedPose, ...], Field(min_length=2), AfterValidator(_increasing)]
"""Poses in temporal order."""


class GesturesFile(Model):
    """A file of gestures."""

    title: str = ""
    """Description of the gestures."""

    poses: TimedPoses
    """The poses that it goes through, in the order of their times."""


class GesturesConfig(Model):
    """Smooth motion of a hand through poses, shipped, in a file, or inline."""

    kind: Literal["gestures"] = "gestures"

    name: str | None = None
    """Shipped gestures: ``point_and_pinch``, ``fists`` or ``signs``."""

    path: InputPath | None = None
    """A YAML file with ``poses``, and optionally a ``title``."""

    poses: TimedPoses | None = None
    """The poses, in the order of their times."""

    sway: Annotated[float, Field(ge=0.0, le=100.0)] = 1.0
    """Amplitude of the palm's oscillation about the centre of the hand, with a period of two
    seconds: 0 for none, 1 for up to 40 degrees."""

    sway_phase_deg: Angle = 0.0
    """Initial phase of the oscillation [deg]; at 0 and 180 the palm faces the camera."""

    @model_validator(mode="after")
    def _one_of_them(self) -> GesturesConfig:
        if self.poses is None:
            GESTURES.check_choice(self.name, self.path)
        elif self.name or self.path:
            raise ValueError("give one of name, path and poses")
        return self

    def motion(self) -> HandMotion:
        """Returns the motion of the hand.

        Raises:
            RegkitError: If the file is missing or invalid.
        """
        timed = self._timed()
        times = np.array([pose.time for pose in timed])
        gestures = Gestures(times, tuple(pose.hand() for pose in timed))
        return HandMotion(gestures, self.sway, radians(self.sway_phase_deg))

    def _timed(self) -> tuple[TimedPose, ...]:
        if self.poses is not None:
            return self.poses
        path = self.path or GESTURES.path(self.name or "")
        return Document.read(path).validated(GesturesFile).poses


class HandsConfig(Model):
    """What the fingers of both hands of a person do, while the person's motion moves the hands."""

    right: GesturesConfig
    """Gestures of the right hand; their sway has no effect."""

    left: GesturesConfig
    """Gestures of the left hand, mirrored."""
