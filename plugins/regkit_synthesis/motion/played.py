"""Changes of the speed and the place of motions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.geometry.rotation import vector_to_matrix
from regkit.system.arrays import Array
from regkit_synthesis.motion.motion import Motion, SourcePose


@dataclass(frozen=True)
class Played(Motion):
    """A motion with another start, speed or velocity.

    Attributes:
        motion: The motion.
        start: Start time within the motion [s].
        speed: Playback speed; 1 is the recorded speed.
        taken_out: Velocity (3,) that is subtracted, as on a treadmill [m/s].
    """

    motion: Motion
    start: float
    speed: float
    taken_out: Array

    @classmethod
    def of(cls, motion: Motion, start: float = 0.0, speed: float = 1.0, way: float = 1.0) -> Played:
        """Returns the motion with the fraction ``way`` of its mean velocity."""
        taken_out = (1.0 - way) * motion.velocity
        return cls(motion.rig, motion.loops, motion, start, speed, taken_out)

    @property
    def duration(self) -> float:
        """Duration at the playback speed [s]; of one period if it loops."""
        begin = 0.0 if self.loops else self.start
        return (self.motion.duration - begin) / self.speed

    def at(self, time: float) -> SourcePose:
        """Returns the pose at ``time`` [s] at the playback speed."""
        played = self.speed * time
        pose = self.motion.at(self.start + played)
        if not self.loops:
            # The motion is constant before its beginning and after its end.
            played = float(np.clip(played, -self.start, self.motion.duration - self.start))
        return SourcePose(pose.root - played * self.taken_out, pose.rotations)


@dataclass(frozen=True)
class Placed(Motion):
    """A motion at another place on the ground.

    Attributes:
        motion: The motion.
        rotation: Rotation about the vertical axis through the origin, (3, 3).
        shift: Translation along the ground after the rotation, (3,) [m].
    """

    motion: Motion
    rotation: Array
    shift: Array

    @classmethod
    def ahead(cls, motion: Motion) -> Placed:
        """Returns the motion that starts above the origin, with the hips facing forward (-y)."""
        pose = motion.at(0.0)
        facing = -pose.rotations[motion.rig.parts["pelvis"]][:, 1]
        turn = np.arctan2(facing[0], -facing[1])
        rotation = vector_to_matrix(np.array([0.0, 0.0, -turn]))
        return cls(motion.rig, motion.loops, motion, rotation, rotation @ pose.root * [-1, -1, 0])

    @property
    def duration(self) -> float:
        """Duration of the motion [s]."""
        return self.motion.duration

    def at(self, time: float) -> SourcePose:
        """Returns the pose at ``time`` [s] at the new place."""
        pose = self.motion.at(time)
        turned = {joint: self.rotation @ matrix for joint, matrix in pose.rotations.items()}
        return SourcePose(self.rotation @ pose.root + self.shift, turned)
