"""Motion of a hand that runs through recorded poses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.system.arrays import Array
from regkit_synthesis.hands.pose import HandPose, chained
from regkit_synthesis.motion.mending import interpolated


@dataclass(frozen=True)
class Gestures:
    """A hand that goes smoothly from pose to pose, and rests in each at its time.

    Attributes:
        times: (K,) when each pose is reached [s], increasing.
        poses: The K poses.
    """

    times: Array
    poses: tuple[HandPose, ...]

    def at(self, time: float) -> dict[str, Array]:
        """The rotation (3, 3) ``R_wrist_joint`` of every joint at ``time`` [s]."""
        right = int(
            np.clip(np.searchsorted(self.times, time, side="right"), 1, len(self.times) - 1)
        )
        begin, end = float(self.times[right - 1]), float(self.times[right])
        share = float(np.clip((time - begin) / (end - begin), 0.0, 1.0))
        smooth = share * share * (3.0 - 2.0 * share)
        start, goal = self.poses[right - 1], self.poses[right]
        return chained(interpolated(start.joints, goal.joints, smooth))
