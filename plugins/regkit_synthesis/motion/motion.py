"""The motion of a figure, whatever it comes from."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from regkit.system.arrays import Array
from regkit_synthesis.figure.figure import FIGURE


@dataclass(frozen=True)
class Rig:
    """The joints of a source of motion, as it stands at rest.

    The axes are the ground's: x to the figure's left, y backward, z up.

    Attributes:
        parents: Each joint's parent, which stands before it; empty for the root.
        places: (3,) where each joint and each end of a limb is at rest [m].
        parts: The source's joint for each joint of the figure that it has.
    """

    parents: Mapping[str, str]
    places: Mapping[str, Array]
    parts: Mapping[str, str]

    def moving(self, joint: str) -> str | None:
        """The source's joint that moves ``joint``: a joint of the figure, or one of its own.

        A joint of the figure that the source does not have moves with the one before it. None means
        that there is no joint of this name at all.
        """
        while joint in FIGURE:
            own = self.parts.get(joint)
            if own in self.parents:
                return own
            joint = FIGURE[joint]
        return joint if joint in self.parents else None

    @property
    def figure(self) -> dict[str, Array]:
        """Where the joints of the figure are at rest (3,) [m], as far as the source has them."""
        return {joint: self.places[own] for joint, own in self.parts.items()}


@dataclass(frozen=True)
class SourcePose:
    """One pose of a source.

    Attributes:
        root: (3,) the middle of the hips in ground axes [m].
        rotations: Rotation (3, 3) ``R_ground_joint`` of each of the source's joints; all are the
            identity at rest.
    """

    root: Array
    rotations: Mapping[str, Array]


@dataclass(frozen=True)
class Motion(ABC):
    """A motion that can be asked for any time.

    Attributes:
        rig: The joints that move.
        loops: Whether it goes on from its beginning when it ends.
    """

    rig: Rig
    loops: bool

    @property
    @abstractmethod
    def duration(self) -> float:
        """From its beginning to its end [s]."""

    @abstractmethod
    def at(self, time: float) -> SourcePose:
        """The pose at ``time`` [s].

        A motion that loops goes on from where it ends, so that a walk walks on; another one holds
        its first pose before it and its last pose after it.
        """

    @property
    def velocity(self) -> Array:
        """The mean velocity of the hips (3,) along the ground [m/s]."""
        way = self.at(self.duration).root - self.at(0.0).root
        return np.asarray(way / self.duration * [1.0, 1.0, 0.0])
