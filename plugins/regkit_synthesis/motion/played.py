"""Motions that are played, or placed, in another way than they were recorded."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.geometry.rotation import vector_to_matrix
from regkit.system.arrays import Array
from regkit_synthesis.motion.motion import Motion, SourcePose


@dataclass(frozen=True)
class Played(Motion):
    """A motion that is played in another way.

    Attributes:
        motion: The motion.
        start: Where in it time begins [s].
        speed: How fast it is played; 1 is as recorded.
        taken_out: Velocity (3,) that is taken out of it, as on a treadmill [m/s].
    """

    motion: Motion
    start: float
    speed: float
    taken_out: Array

    @classmethod
    def of(cls, motion: Motion, start: float = 0.0, speed: float = 1.0, way: float = 1.0) -> Played:
        """``motion`` of whose mean velocity only the share ``way`` is kept."""
        taken_out = (1.0 - way) * motion.velocity
        return cls(motion.rig, motion.loops, motion, start, speed, taken_out)

    @property
    def duration(self) -> float:
        """From where it begins to its end [s], as it is played; of a loop, once around."""
        begin = 0.0 if self.loops else self.start
        return (self.motion.duration - begin) / self.speed

    def at(self, time: float) -> SourcePose:
        """The pose at ``time`` [s] of the motion as it is played."""
        played = self.speed * time
        pose = self.motion.at(self.start + played)
        if not self.loops:
            # Where it holds its first or its last pose, it stays there.
            played = float(np.clip(played, -self.start, self.motion.duration - self.start))
        return SourcePose(pose.root - played * self.taken_out, pose.rotations)


@dataclass(frozen=True)
class Placed(Motion):
    """A motion that takes place elsewhere on the ground.

    Attributes:
        motion: The motion.
        rotation: (3, 3) turns it about the vertical through the origin.
        shift: (3,) along the ground, after that [m].
    """

    motion: Motion
    rotation: Array
    shift: Array

    @classmethod
    def ahead(cls, motion: Motion) -> Placed:
        """``motion`` that begins above the origin, with the hips facing forward, along -y."""
        pose = motion.at(0.0)
        facing = -pose.rotations[motion.rig.parts["pelvis"]][:, 1]
        turn = np.arctan2(facing[0], -facing[1])
        rotation = vector_to_matrix(np.array([0.0, 0.0, -turn]))
        return cls(motion.rig, motion.loops, motion, rotation, rotation @ pose.root * [-1, -1, 0])

    @property
    def duration(self) -> float:
        """From its beginning to its end [s]."""
        return self.motion.duration

    def at(self, time: float) -> SourcePose:
        """The pose at ``time`` [s] where it takes place."""
        pose = self.motion.at(time)
        turned = {joint: self.rotation @ matrix for joint, matrix in pose.rotations.items()}
        return SourcePose(self.rotation @ pose.root + self.shift, turned)
