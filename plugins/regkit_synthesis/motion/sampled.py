"""Recorded motions: samples of joint rotations, repaired and interpolated."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from regkit.geometry.rotation import from_matrix, to_matrix
from regkit.system.arrays import Array
from regkit_synthesis.motion import mending
from regkit_synthesis.motion.mending import interpolated
from regkit_synthesis.motion.motion import Motion, Rig, SourcePose


@dataclass(frozen=True)
class SampledMotion(Motion):
    """A recorded motion with spherical linear interpolation.

    Attributes:
        times: Time of each sample, starting at zero, (F,) [s].
        roots: Centre of the hips, (F, 3) [m].
        joints: Rotation from rest of each joint relative to its parent, in ground axes, (F, J, 4).
    """

    times: Array
    roots: Array
    joints: Array

    @property
    def duration(self) -> float:
        """Time of the last sample [s]."""
        return float(self.times[-1])

    def at(self, time: float) -> SourcePose:
        """Returns the pose at ``time`` [s]."""
        period = self.duration
        cycle = np.floor(time / period) if self.loops else 0.0
        within = float(np.clip(time - cycle * period, 0.0, period))
        right = int(
            np.clip(np.searchsorted(self.times, within, side="right"), 1, len(self.times) - 1)
        )
        left = right - 1
        share = (within - self.times[left]) / (self.times[right] - self.times[left])
        joints = interpolated(self.joints[left], self.joints[right], share)
        root = (1.0 - share) * self.roots[left] + share * self.roots[right]
        rotations: dict[str, Array] = {}
        for (joint, parent), matrix in zip(
            self.rig.parents.items(), to_matrix(joints), strict=True
        ):
            rotations[joint] = rotations[parent] @ matrix if parent else matrix
        return SourcePose(root + cycle * period * self.velocity if cycle else root, rotations)

    @property
    def velocity(self) -> Array:
        """Returns the mean velocity (3,) of the hips along the ground [m/s]."""
        return np.asarray((self.roots[-1] - self.roots[0]) / self.duration * [1.0, 1.0, 0.0])

    def bridged(self, row: int) -> SampledMotion:
        """Returns the motion without the discontinuity between ``row`` and the next.

        Some motions are concatenated from parts that do not match exactly. Both sides are adjusted
        so that this step becomes the mean of the adjacent ones.
        """
        return replace(self, joints=mending.bridged(self.times, self.joints, row))

    def smoothed(self) -> SampledMotion:
        """Returns the motion with every rotation averaged with the mean of its neighbours."""
        return replace(self, joints=mending.smoothed(self.joints))

    def closed(self) -> SampledMotion:
        """Returns the motion with its final rotations adjusted to match the initial ones."""
        return replace(self, joints=mending.closed(self.times, self.joints))

    def looped(self) -> SampledMotion:
        """Returns the motion as a loop, with its end adjusted to the pose and height of its start.

        Use it for motions that were not recorded as loops but return close to their first pose.
        """
        roots = self.roots.copy()
        roots[:, 2] += mending.closing(self.times) * (roots[0, 2] - roots[-1, 2])
        return replace(self.closed(), roots=roots, loops=True)


def recorded(rig: Rig, times: Array, roots: Array, turns: Array) -> SampledMotion:
    """Returns a motion that does not loop, from rotations in ground axes.

    Args:
        rig: The J joints.
        times: Time of each sample, starting at zero, (F,) [s].
        roots: Centre of the hips, (F, 3) [m].
        turns: Rotation ``R_ground_joint`` of each joint from rest, (F, J, 3, 3).
    """
    names = list(rig.parents)
    relative = turns.copy()
    for index, parent in enumerate(rig.parents.values()):
        if parent:
            before = turns[:, names.index(parent)]
            relative[:, index] = np.swapaxes(before, -1, -2) @ turns[:, index]
    return SampledMotion(rig, False, times, roots, from_matrix(relative))
