"""What the bones of a body turn with."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from regkit.geometry.rotation import from_matrix, swing_twist, to_matrix, vector_to_matrix
from regkit.system.arrays import Array
from regkit_synthesis.motion.mending import interpolated
from regkit_synthesis.motion.motion import SourcePose


class Follower(ABC):
    """What a bone turns with."""

    @abstractmethod
    def turn(self, pose: SourcePose) -> Array:
        """The rotation (3, 3) of the bone from its rest, in ground axes."""


@dataclass(frozen=True)
class Segment(Follower):
    """A segment of the source.

    Attributes:
        joint: The source's joint that moves it.
        straight: (3, 3) turns it from the body's rest to the source's.
    """

    joint: str
    straight: Array

    def turn(self, pose: SourcePose) -> Array:
        """The segment's rotation (3, 3)."""
        return np.asarray(pose.rotations[self.joint] @ self.straight)


@dataclass(frozen=True)
class Blended(Follower):
    """Something between two segments.

    Attributes:
        start: The first one.
        end: The second one.
        share: How far from the first to the second.
    """

    start: Segment
    end: Segment
    share: float

    def turn(self, pose: SourcePose) -> Array:
        """The rotation (3, 3) on the shortest way between both."""
        start, end = (from_matrix(segment.turn(pose)) for segment in (self.start, self.end))
        return to_matrix(interpolated(start, end, self.share))


@dataclass(frozen=True)
class Twisted(Follower):
    """A segment that is twisted as another one at its end is, as a forearm by the hand.

    Attributes:
        start: The segment.
        end: The one at its end.
        share: How much of the twist arrives here.
        axis: (3,) unit vector along the bone at rest.
    """

    start: Segment
    end: Segment
    share: float
    axis: Array

    def turn(self, pose: SourcePose) -> Array:
        """The segment's rotation (3, 3) after a part of the other's twist."""
        start = self.start.turn(pose)
        _, twist = swing_twist(from_matrix(start.T @ self.end.turn(pose)), self.axis)
        return np.asarray(start @ vector_to_matrix(self.share * twist * self.axis))
