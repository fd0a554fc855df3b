"""BVH motion: a tree of joints, and the values of its channels in every frame.

Source: Meredith, Maddock, Motion Capture File Formats Explained, University of Sheffield, 2001,
section 3.2. The format has no units of length; angles are in degrees. A joint's rotation is the
product of its channels' rotations in file order. A position channel replaces the offset along its
axis, as in Blender and MotionBuilder; for a zero offset, which most roots have, this is the same as
adding them.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from regkit.geometry.rotation import to_matrix
from regkit.interchange.bvh.frames import read_motion
from regkit.interchange.bvh.hierarchy import (
    BvhJoint,
    hierarchy_text,
    in_file_order,
    read_hierarchy,
    row,
)
from regkit.interchange.bvh.lines import Lines
from regkit.interchange.bvh.pose import BvhPose, posed, relative_positions, relative_rotations
from regkit.interchange.encodings import Decoded
from regkit.interchange.gltf.slerp import slerp
from regkit.interchange.remarks import Remarks
from regkit.system.arrays import Array, read_only
from regkit.system.errors import DataError
from regkit.system.files import write_text
from regkit.system.guard import reading


@dataclass(frozen=True, eq=False)
class Bvh:
    """A motion and its skeleton.

    Attributes:
        joints: The J joints, parents before children.
        frame_time: Time between frames [s]; zero if the file has none.
        frames: Values of all channels in the order of the joints, (F, C): positions [m], angles
            [deg].
    """

    joints: tuple[BvhJoint, ...]
    frame_time: float
    frames: Array

    @classmethod
    def read(cls, path: Path, *, scale: float = 1.0, posed: bool = True) -> Bvh:
        """Reads a file; what is assumed or left out is told.

        Args:
            path: The file.
            scale: Metres per unit of the file; 0.01 for centimetres.
            posed: Whether the frames matter. If not, frames that cannot be read are left out.

        Raises:
            DataError: If the file is missing or invalid.
        """
        with reading(path, "a BVH file"):
            decoded = Decoded.of(path.read_bytes())
            lines, remarks = Lines(path, decoded.text), Remarks()
            joints = read_hierarchy(lines, scale, remarks)
            decoded.tell(path)
            frame_time, frames = read_motion(lines, joints, posed=posed)
            remarks.tell()
        names = [channel for joint in joints for channel in joint.channels]
        frames[:, [name.endswith("position") for name in names]] *= scale
        return cls(joints, frame_time, read_only(frames))

    def write(self, path: Path, *, scale: float = 1.0) -> None:
        """Writes a file.

        Args:
            path: The file.
            scale: Metres per unit of the file.

        Raises:
            DataError: If the file cannot be written.
        """
        counts = [len(joint.channels) for joint in self.joints]
        columns = np.split(self.frames, np.cumsum(counts)[:-1], axis=1)
        order = in_file_order(self.joints)
        frames = np.concatenate([columns[index] for index in order], axis=1)
        names = [channel for index in order for channel in self.joints[index].channels]
        frames[:, [name.endswith("position") for name in names]] /= scale
        head = ["MOTION", f"Frames: {len(self.frames)}", f"Frame Time: {self.frame_time:.10g}"]
        lines = [*hierarchy_text(self.joints, scale), *head, *map(row, frames)]
        write_text(path, "\n".join(lines) + "\n")

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the joints, (J,)."""
        return tuple(joint.name for joint in self.joints)

    @property
    def parents(self) -> tuple[int, ...]:
        """Index of each joint's parent, (J,); -1 for the root."""
        return tuple(joint.parent for joint in self.joints)

    @property
    def duration(self) -> float:
        """Time from the first frame to the last [s]."""
        return self.frame_time * max(0, len(self.frames) - 1)

    @cached_property
    def rest_positions(self) -> Array:
        """Positions of the joints at zero angles with the root at its offset, (J, 3) [m]."""
        positions = np.zeros((len(self.joints), 3))
        for index, joint in enumerate(self.joints):
            parent = positions[joint.parent] if joint.parent >= 0 else 0.0
            positions[index] = parent + joint.offset
        return positions

    def offsets(self, joint: int) -> Array:
        """Returns the position of a joint relative to its parent in every frame, (F, 3) [m]."""
        return self._positions[:, joint]

    def at_frame(self, index: int) -> BvhPose:
        """Returns the pose in a frame.

        Raises:
            IndexError: If there is no such frame.
        """
        return posed(self.joints, self._rotations[index], self._positions[index])

    def at(self, time: float) -> BvhPose:
        """Returns the pose at ``time`` [s], with spherical interpolation of each joint's rotation.

        The pose is constant before the first and after the last frame.

        Raises:
            DataError: If the motion has no frames, or no time between them.
        """
        if not len(self.frames) or self.frame_time <= 0.0:
            raise DataError(
                f"the motion has {len(self.frames)} frames and a frame time of "
                f"{self.frame_time:g} s; both must be positive"
            )
        exact = float(np.clip(time / self.frame_time, 0.0, len(self.frames) - 1.0))
        left = min(int(exact), max(0, len(self.frames) - 2))
        right = min(left + 1, len(self.frames) - 1)
        share = exact - left
        rotations, positions = self._rotations, self._positions
        return posed(
            self.joints,
            slerp(rotations[left], rotations[right], share),
            (1.0 - share) * positions[left] + share * positions[right],
        )

    def rotations(self, joint: int) -> Array:
        """Returns the rotation of a joint relative to its parent in every frame, (F, 3, 3)."""
        return to_matrix(self._rotations[:, joint])

    @cached_property
    def _rotations(self) -> Array:
        return relative_rotations(self.joints, self.frames)

    @cached_property
    def _positions(self) -> Array:
        return relative_positions(self.joints, self.frames)
