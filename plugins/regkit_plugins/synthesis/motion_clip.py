"""Recorded body motion in the JSON format of DeepMimic and pybullet's humanoid."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from regkit.arrays import Array
from regkit.errors import DataError
from regkit.rotation import IDENTITY, from_vector, normalized, product, to_matrix
from regkit_plugins.synthesis import mending
from regkit_plugins.synthesis.mending import interpolated

SEGMENTS = {
    "root": "",
    "chest": "root",
    "neck": "chest",
    "right_hip": "root",
    "right_knee": "right_hip",
    "right_ankle": "right_knee",
    "right_shoulder": "chest",
    "right_elbow": "right_shoulder",
    "left_hip": "root",
    "left_knee": "left_hip",
    "left_ankle": "left_knee",
    "left_shoulder": "chest",
    "left_elbow": "left_shoulder",
}
"""The segments, named by the joint that moves them, in the order of the file; and their parents."""

_HINGES = frozenset({"right_knee", "right_elbow", "left_knee", "left_elbow"})
"""Joints with one angle about z, to the character's right; all others have a quaternion w x y z."""

_ROW = 44
"""Numbers in a row: duration, root position, then the rotations."""


@dataclass(frozen=True)
class ClipPose:
    """One pose of the character: x forward, y up, z to its right.

    Attributes:
        root: (3,) position of the middle of the hips [m].
        rotations: Rotation (3, 3) ``R_world_segment`` of each of ``SEGMENTS``; all are the identity
            where it stands upright with its arms hanging straight down.
    """

    root: Array
    rotations: dict[str, Array]


@dataclass(frozen=True)
class MotionClip:
    """A recorded motion that can be asked for any time.

    Attributes:
        times: (F,) time of each row, from zero [s].
        roots: (F, 3) position of the middle of the hips [m].
        joints: (F, 13, 4) rotation of each of ``SEGMENTS`` against its parent.
        loops: Whether the motion goes on from its beginning when it ends.
    """

    times: Array
    roots: Array
    joints: Array
    loops: bool

    @classmethod
    def read(cls, path: Path) -> MotionClip:
        """Read a clip; the end of a looping one is bent a little so that it meets its beginning.

        Raises:
            DataError: If the file is missing or is not such a clip.
        """
        try:
            content = json.loads(path.read_text(encoding="utf-8"))
            rows = np.array(content["Frames"], dtype=np.float64)
            loops = str(content["Loop"]) == "wrap"
        except FileNotFoundError:
            raise DataError(
                "the file is missing; it holds a motion clip", place=str(path)
            ) from None
        except (KeyError, ValueError, TypeError) as error:
            raise DataError(
                f"not a motion clip ({type(error).__name__}: {error}); it must be JSON "
                "with Loop and Frames",
                place=str(path),
            ) from None
        if rows.ndim != 2 or rows.shape[1] != _ROW or len(rows) < 2:
            raise DataError(
                f"Frames has the shape {rows.shape}; it must have 2 or more rows of {_ROW} numbers",
                place=str(path),
            )
        times = np.concatenate([[0.0], np.cumsum(rows[:-1, 0])])
        joints = _joints(rows[:, 4:])
        return cls(times, rows[:, 1:4], mending.closed(times, joints) if loops else joints, loops)

    def bridged(self, row: int) -> MotionClip:
        """The clip without the jump between ``row`` and the next.

        Some clips are joined from parts that do not quite meet. Both sides are bent towards each
        other, so that this step becomes the mean of its neighbours.
        """
        return replace(self, joints=mending.bridged(self.times, self.joints, row))

    def smoothed(self) -> MotionClip:
        """The clip with every rotation drawn halfway to the mean of those before and after it."""
        return replace(self, joints=mending.smoothed(self.joints))

    def with_arms_turned_out(self, angle: float) -> MotionClip:
        """The clip with both upper arms turned outward about themselves by ``angle`` [rad].

        The clips' character is slim: the bent arms of another body may go through its trunk.
        """
        joints = self.joints.copy()
        for segment, sense in (("right_shoulder", -1.0), ("left_shoulder", 1.0)):
            index = list(SEGMENTS).index(segment)
            turn = from_vector(np.array([0.0, sense * angle, 0.0]))
            joints[:, index] = product(joints[:, index], turn)
        return replace(self, joints=joints)

    def looped(self) -> MotionClip:
        """The clip bent so that it ends as it begins, at the same height, and goes on from there.

        For a clip that was not recorded to loop, but comes back to nearly its first pose.
        """
        roots = self.roots.copy()
        roots[:, 1] += mending.closing(self.times) * (roots[0, 1] - roots[-1, 1])
        joints = mending.closed(self.times, self.joints)
        return replace(self, roots=roots, joints=joints, loops=True)

    @property
    def velocity(self) -> Array:
        """The mean velocity of the hips (3,) along the ground [m/s]."""
        return np.asarray((self.roots[-1] - self.roots[0]) / self.times[-1] * [1.0, 0.0, 1.0])

    def at(self, time: float) -> ClipPose:
        """The pose at ``time`` [s], interpolated along the shortest rotations.

        A looping clip goes on from where it ends, so that a walk walks on; another one holds its
        first pose before it and its last pose after it.
        """
        period = float(self.times[-1])
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
        for (segment, parent), matrix in zip(SEGMENTS.items(), to_matrix(joints), strict=True):
            rotations[segment] = rotations[parent] @ matrix if parent else matrix
        return ClipPose(root + cycle * period * self.velocity, rotations)


def _joints(numbers: Array) -> Array:
    """The rotations (F, 13, 4) of the columns (F, 40) that follow the root's position."""
    joints = np.tile(IDENTITY, (len(numbers), len(SEGMENTS), 1))
    column = 0
    for index, segment in enumerate(SEGMENTS):
        if segment in _HINGES:
            joints[:, index] = from_vector(numbers[:, column, None] * np.array([0.0, 0.0, 1.0]))
            column += 1
        else:
            joints[:, index] = np.roll(numbers[:, column : column + 4], -1, axis=1)
            column += 4
    return normalized(joints)
