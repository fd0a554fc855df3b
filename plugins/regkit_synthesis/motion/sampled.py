"""A recorded motion: rows of joint rotations, mended and interpolated."""

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
    """A recorded motion, interpolated along the shortest rotations.

    Attributes:
        times: (F,) time of each row, from zero [s].
        roots: (F, 3) the middle of the hips [m].
        joints: (F, J, 4) rotation of each joint of the rig against its parent, from rest; in ground
            axes.
    """

    times: Array
    roots: Array
    joints: Array

    @property
    def duration(self) -> float:
        """The time of the last row [s]."""
        return float(self.times[-1])

    def at(self, time: float) -> SourcePose:
        """The pose at ``time`` [s]."""
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
        """The mean velocity of the hips (3,) along the ground [m/s]."""
        return np.asarray((self.roots[-1] - self.roots[0]) / self.duration * [1.0, 1.0, 0.0])

    def bridged(self, row: int) -> SampledMotion:
        """The sampled motion without the jump between ``row`` and the next.

        Some are joined from parts that do not quite meet. Both sides are bent towards each other,
        so that this step becomes the mean of its neighbours.
        """
        return replace(self, joints=mending.bridged(self.times, self.joints, row))

    def smoothed(self) -> SampledMotion:
        """The sampled motion with every rotation drawn halfway to the mean of those beside it."""
        return replace(self, joints=mending.smoothed(self.joints))

    def closed(self) -> SampledMotion:
        """The sampled motion with its rotations bent so that they end as they begin."""
        return replace(self, joints=mending.closed(self.times, self.joints))

    def looped(self) -> SampledMotion:
        """The sampled motion bent so that it ends as it begins, at the same height, and goes on.

        For one that was not recorded to loop, but comes back to nearly its first pose.
        """
        roots = self.roots.copy()
        roots[:, 2] += mending.closing(self.times) * (roots[0, 2] - roots[-1, 2])
        return replace(self.closed(), roots=roots, loops=True)


def recorded(rig: Rig, times: Array, roots: Array, turns: Array) -> SampledMotion:
    """A sampled motion that does not loop, from rotations in the ground's axes.

    Args:
        rig: The J joints.
        times: (F,) time of each row, from zero [s].
        roots: (F, 3) the middle of the hips [m].
        turns: (F, J, 3, 3) rotation ``R_ground_joint`` of each joint from rest.
    """
    names = list(rig.parents)
    relative = turns.copy()
    for index, parent in enumerate(rig.parents.values()):
        if parent:
            before = turns[:, names.index(parent)]
            relative[:, index] = np.swapaxes(before, -1, -2) @ turns[:, index]
    return SampledMotion(rig, False, times, roots, from_matrix(relative))
