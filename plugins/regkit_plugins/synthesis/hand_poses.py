"""Recorded hand poses in the JavaScript files of iwer, and gestures that run through them."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from regkit.arrays import Array
from regkit.errors import DataError
from regkit.rotation import conjugate, from_matrix, product, to_matrix
from regkit_plugins.synthesis.motion_clip import interpolated

WRIST = "wrist"

_PARTS = ("metacarpal", "phalanx-proximal", "phalanx-intermediate", "phalanx-distal", "tip")

CHAINS = {
    "thumb": tuple(f"thumb-{part}" for part in _PARTS if part != "phalanx-intermediate"),
    **{
        finger: tuple(f"{finger}-finger-{part}" for part in _PARTS)
        for finger in ("index", "middle", "ring", "pinky")
    },
}
"""The WebXR joints of each finger, from the wrist outwards."""

PARENTS = {
    joint: parent
    for chain in CHAINS.values()
    for parent, joint in zip((WRIST, *chain), chain, strict=False)
}
"""Every joint but the wrist, and the one that it turns against."""

_JOINT = re.compile(r"'?([a-z-]+)'?:\s*\{\s*offsetMatrix:\s*\[([^\]]*)\]")


@dataclass(frozen=True)
class HandPose:
    """A right hand in its wrist's frame: x to the little finger, y out of the back, z backward.

    Attributes:
        origins: Position (3,) of each WebXR joint [m].
        joints: (24, 4) rotation of each of ``PARENTS`` against the joint before it.
    """

    origins: dict[str, Array]
    joints: Array

    @classmethod
    def read(cls, path: Path) -> HandPose:
        """Read one of iwer's poses, which are of a left hand, as that of a right hand.

        Raises:
            DataError: If the file is missing or does not have the 25 joints of WebXR.
        """
        try:
            text = path.read_text(encoding="utf-8")
        except FileNotFoundError:
            raise DataError("the file is missing; it holds a hand pose", place=str(path)) from None
        matrices = {name: _matrix(numbers, path) for name, numbers in _JOINT.findall(text)}
        missing = [joint for joint in (WRIST, *PARENTS) if joint not in matrices]
        if missing:
            raise DataError(
                f"no offsetMatrix for {', '.join(missing)}; all 25 joints of WebXR must be there",
                place=str(path),
            )
        mirror = np.diag([-1.0, 1.0, 1.0])
        wrist = matrices[WRIST]
        turns = {
            joint: from_matrix(mirror @ wrist[:3, :3].T @ matrix[:3, :3] @ mirror)
            for joint, matrix in matrices.items()
        }
        origins = {
            joint: mirror @ wrist[:3, :3].T @ (matrix[:3, 3] - wrist[:3, 3])
            for joint, matrix in matrices.items()
        }
        joints = [
            product(conjugate(turns[parent]), turns[joint]) for joint, parent in PARENTS.items()
        ]
        return cls(origins, np.array(joints))

    def rotations(self) -> dict[str, Array]:
        """``R_wrist_joint`` (3, 3) of every joint: -z along the bone, y out of the back."""
        return chained(self.joints)


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


def chained(joints: Array) -> dict[str, Array]:
    """The rotations (3, 3) against the wrist, of rotations (24, 4) against the joint before."""
    rotations = {WRIST: np.eye(3)}
    for (joint, parent), matrix in zip(PARENTS.items(), to_matrix(joints), strict=True):
        rotations[joint] = rotations[parent] @ matrix
    return rotations


def _matrix(numbers: str, path: Path) -> Array:
    """The 4x4 matrix of 16 numbers, stored by columns."""
    try:
        values = np.array([float(number) for number in numbers.split(",") if number.strip()])
        return values.reshape(4, 4, order="F")
    except ValueError as error:
        raise DataError(f"an offsetMatrix is not 16 numbers ({error})", place=str(path)) from None
