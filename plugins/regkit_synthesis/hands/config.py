"""What a user writes about the motion of a hand."""

from __future__ import annotations

from itertools import pairwise
from math import radians
from typing import Annotated, Literal

import numpy as np
from pydantic import AfterValidator, Field, model_validator

from regkit.config.document import Document
from regkit.config.model import InputPath, Model
from regkit_synthesis.assets import ASSETS
from regkit_synthesis.hands.gestures import Gestures
from regkit_synthesis.hands.motion import HandMotion
from regkit_synthesis.hands.pose import HandPose
from regkit_synthesis.hands.shipped import PoseName, shipped_pose
from regkit_synthesis.motion.shipped import Shelf

GESTURES = Shelf("gestures", ASSETS / "gestures", "", ".yaml")
"""Gestures that were written for regkit."""

_FLAT = "handywork/flat"


class TimedPose(Model):
    """A pose at a time."""

    time: Annotated[float, Field(ge=0.0)]
    """When the hand is in it [s]."""

    pose: PoseName
    """A pose that ships."""

    opened: Annotated[float, Field(ge=0.0, le=1.0)] = 0.0
    """How far the fingers, but not the thumb, are opened towards a flat hand: 1 is flat."""

    thumb: PoseName | None = None
    """The pose that the thumb is taken from, if that is another one."""

    thumb_lift_deg: float = 0.0
    """How far the thumb is turned about its base, out of the palm [deg]."""

    def hand(self) -> HandPose:
        """The pose of the hand."""
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
"""Poses in the order of their times."""


class GesturesFile(Model):
    """A file of gestures."""

    title: str = ""
    """What the hand does."""

    poses: TimedPoses
    """The poses that it goes through, in the order of their times."""


class GesturesConfig(Model):
    """A hand that goes smoothly from pose to pose: gestures that ship, a file, or right here."""

    kind: Literal["gestures"] = "gestures"

    name: str | None = None
    """Gestures that ship with regkit: ``point_and_pinch``, ``fists`` or ``signs``."""

    path: InputPath | None = None
    """A YAML file with ``poses``, and perhaps a ``title``."""

    poses: TimedPoses | None = None
    """The poses, in the order of their times."""

    sway: Annotated[float, Field(ge=0.0)] = 1.0
    """How much the palm sways about the middle of the hand, once in two seconds: 0 holds it still,
    with 1 it turns by up to 40 degrees."""

    sway_phase_deg: float = 0.0
    """Where in its sway the palm begins [deg]; at 0 and 180 it looks into the camera."""

    @model_validator(mode="after")
    def _one_of_them(self) -> GesturesConfig:
        if self.poses is None:
            GESTURES.check_choice(self.name, self.path)
        elif self.name or self.path:
            raise ValueError("give one of name, path and poses")
        return self

    def motion(self) -> HandMotion:
        """The motion of the hand.

        Raises:
            RegkitError: If the file is missing or wrong.
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
