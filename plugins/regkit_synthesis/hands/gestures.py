"""Motion of the fingers through recorded poses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.system.arrays import Array
from regkit_synthesis.hands.pose import HandPose, chained
from regkit_synthesis.motion.mending import interpolated


@dataclass(frozen=True)
class Gestures:
    """Smooth motion through poses, at rest in each of them.

    Attributes:
        times: Time of each pose, increasing, (K,) [s].
        poses: The K poses.
    """

    times: Array
    poses: tuple[HandPose, ...]

    def at(self, time: float) -> dict[str, Array]:
        """Returns the rotations ``R_wrist_joint`` (3, 3) of all joints at ``time`` [s]."""
        right = int(
            np.clip(np.searchsorted(self.times, time, side="right"), 1, len(self.times) - 1)
        )
        begin, end = float(self.times[right - 1]), float(self.times[right])
        share = float(np.clip((time - begin) / (end - begin), 0.0, 1.0))
        smooth = share * share * (3.0 - 2.0 * share)
        start, goal = self.poses[right - 1], self.poses[right]
        return chained(interpolated(start.joints, goal.joints, smooth))
