"""Motion clips in the JSON format of DeepMimic and pybullet's humanoid."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from regkit.geometry.rotation import IDENTITY, from_vector, normalized, product
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.guard import reading
from regkit.system.json_files import read_json
from regkit_synthesis.figure.standing import STANDING
from regkit_synthesis.motion.motion import Rig
from regkit_synthesis.motion.sampled import SampledMotion

_R_GROUND_CLIP = np.array([[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
"""From the clip's axes (x forward, y up, z right) to the ground's (x left, y backward, z up)."""

_PARENTS = {
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
"""The joints in file order, and their parents. At rest the character stands upright with its arms
hanging straight down."""

_HINGES = frozenset({"right_knee", "right_elbow", "left_knee", "left_elbow"})
"""Joints with one angle about z, the character's right; all others have a quaternion w x y z."""

_ROW = 44
"""Number of values in a row: duration, root position, rotations."""

LONGEST = 1000.0
"""Longest duration of a row [s]; a longer one is no pose of a motion."""


_PARTS = {
    "pelvis": "root",
    "chest": "chest",
    "head": "neck",
    **{
        f"{side}_{joint}": f"{side}_{joint}"
        for side in ("left", "right")
        for joint in ("hip", "knee", "ankle", "foot", "shoulder", "elbow", "wrist")
    },
}
"""Joint of the clip for each joint of the figure: its neck moves the head. Feet and wrists are
ends."""

RIG = Rig(_PARENTS, {own: STANDING[joint] for joint, own in _PARTS.items()}, _PARTS)
"""The character of the clips."""


def read_clip(path: Path) -> SampledMotion:
    """Reads a clip; the end of a looping one is adjusted slightly to match its beginning.

    Raises:
        DataError: If the file is missing or is not a clip.
    """
    with reading(path, "a motion clip, JSON with Loop and Frames"):
        content = read_json(path)
        rows = np.array(content["Frames"], dtype=np.float64)
        loops = str(content["Loop"]) == "wrap"
        if not np.isfinite(rows).all():
            raise DataError("Frames has numbers that are NaN or infinite")
    if rows.ndim != 2 or rows.shape[1] != _ROW or len(rows) < 2:
        raise DataError(
            f"Frames has the shape {rows.shape}; it must have 2 or more rows of {_ROW} numbers",
            place=str(path),
        )
    wrong = np.flatnonzero((rows[:-1, 0] <= 0.0) | (rows[:-1, 0] > LONGEST))
    if len(wrong):
        raise DataError(
            f"row {wrong[0]} of Frames lasts {rows[wrong[0], 0]:g} s; it must be above 0 and at "
            f"most {LONGEST:g} s",
            place=str(path),
        )
    times = np.concatenate([[0.0], np.cumsum(rows[:-1, 0])])
    sampled = SampledMotion(
        RIG, loops, times, rows[:, 1:4] @ _R_GROUND_CLIP.T, _joints(rows[:, 4:])
    )
    return sampled.closed() if loops else sampled


def with_arms_turned_out(clip: SampledMotion, angle: float) -> SampledMotion:
    """Returns the clip with both upper arms rotated outward about their axes by ``angle`` [rad].

    The character of the clips is slim; bent arms of other bodies could intersect the trunk.
    """
    joints = clip.joints.copy()
    for joint, sense in (("right_shoulder", -1.0), ("left_shoulder", 1.0)):
        index = list(_PARENTS).index(joint)
        turn = from_vector(np.array([0.0, 0.0, sense * angle]))
        joints[:, index] = product(joints[:, index], turn)
    return replace(clip, joints=joints)


def _joints(numbers: Array) -> Array:
    """Returns the rotations (F, 13, 4) of the columns (F, 40) after the root's position."""
    joints = np.tile(IDENTITY, (len(numbers), len(_PARENTS), 1))
    column = 0
    for index, joint in enumerate(_PARENTS):
        if joint in _HINGES:
            joints[:, index] = from_vector(numbers[:, column, None] * np.array([0.0, 0.0, 1.0]))
            column += 1
        else:
            joints[:, index] = np.roll(numbers[:, column : column + 4], -1, axis=1)
            column += 4
    joints[:, :, :3] = joints[:, :, :3] @ _R_GROUND_CLIP.T
    return normalized(joints)
