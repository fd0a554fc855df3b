"""Followers: how the bones of a body follow the segments of a motion source."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from regkit.geometry.rotation import from_matrix, swing_twist, to_matrix, vector_to_matrix
from regkit.system.arrays import Array
from regkit_synthesis.motion.mending import interpolated
from regkit_synthesis.motion.motion import SourcePose


class Follower(ABC):
    """The rule by which a bone follows a motion source."""

    @abstractmethod
    def turn(self, pose: SourcePose) -> Array:
        """Returns the rotation (3, 3) of the bone from rest, in ground axes."""


@dataclass(frozen=True)
class Segment(Follower):
    """Follows a segment of the source.

    Attributes:
        joint: Joint of the source that moves the segment.
        straight: Rotation from the body's rest to the source's, (3, 3).
    """

    joint: str
    straight: Array

    def turn(self, pose: SourcePose) -> Array:
        """Returns the rotation (3, 3) of the segment."""
        return np.asarray(pose.rotations[self.joint] @ self.straight)


@dataclass(frozen=True)
class Blended(Follower):
    """Interpolates between two segments.

    Attributes:
        start: The first segment.
        end: The second segment.
        share: Fraction of the rotation from the first to the second.
    """

    start: Segment
    end: Segment
    share: float

    def turn(self, pose: SourcePose) -> Array:
        """Returns the interpolated rotation (3, 3)."""
        start, end = (from_matrix(segment.turn(pose)) for segment in (self.start, self.end))
        return to_matrix(interpolated(start, end, self.share))


@dataclass(frozen=True)
class Twisted(Follower):
    """Follows a segment, and the twist of the next one, like a forearm and its hand.

    Attributes:
        start: The segment.
        end: The next segment.
        share: Fraction of the twist.
        axis: Unit vector along the bone at rest, (3,).
    """

    start: Segment
    end: Segment
    share: float
    axis: Array

    def turn(self, pose: SourcePose) -> Array:
        """Returns the rotation (3, 3) of the segment with the fraction of the twist."""
        start = self.start.turn(pose)
        _, twist = swing_twist(from_matrix(start.T @ self.end.turn(pose)), self.axis)
        return np.asarray(start @ vector_to_matrix(self.share * twist * self.axis))
