"""The interface of motions of a figure."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from regkit.system.arrays import Array
from regkit_synthesis.figure.figure import FIGURE


@dataclass(frozen=True)
class Rig:
    """The joints of a motion source at rest.

    The axes are the ground's: x to the figure's left, y backward, z up.

    Attributes:
        parents: Parent of each joint, parents before children; empty for the root.
        places: Position (3,) [m] of each joint and end of a limb at rest.
        parts: Joint of the source for each joint of the figure that it has.
    """

    parents: Mapping[str, str]
    places: Mapping[str, Array]
    parts: Mapping[str, str]

    def moving(self, joint: str) -> str | None:
        """Returns the joint of the source that moves ``joint``, of the figure or the source.

        A joint of the figure that the source lacks moves with its parent. Returns None if there is
        no such joint.
        """
        while joint in FIGURE:
            own = self.parts.get(joint)
            if own in self.parents:
                return own
            joint = FIGURE[joint]
        return joint if joint in self.parents else None

    @property
    def figure(self) -> dict[str, Array]:
        """Positions (3,) [m] at rest of the figure's joints that the source has."""
        return {joint: self.places[own] for joint, own in self.parts.items()}


@dataclass(frozen=True)
class SourcePose:
    """A pose of a motion source.

    Attributes:
        root: Centre of the hips in ground axes, (3,) [m].
        rotations: ``R_ground_joint`` (3, 3) by joint of the source; the identity at rest.
    """

    root: Array
    rotations: Mapping[str, Array]


@dataclass(frozen=True)
class Motion(ABC):
    """A motion, a function of time.

    Attributes:
        rig: The joints of the source.
        loops: Whether the motion repeats.
    """

    rig: Rig
    loops: bool

    @property
    @abstractmethod
    def duration(self) -> float:
        """Duration of the motion [s]."""

    @abstractmethod
    def at(self, time: float) -> SourcePose:
        """Returns the pose at ``time`` [s].

        A looping motion continues from its end position, so that a walk walks on. Others are
        constant before their beginning and after their end.
        """

    @property
    def velocity(self) -> Array:
        """Returns the mean velocity (3,) of the hips along the ground [m/s]."""
        way = self.at(self.duration).root - self.at(0.0).root
        return np.asarray(way / self.duration * [1.0, 1.0, 0.0])
