"""The frames of a BVH file: as many as there are, whatever the file announces."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from regkit.interchange.bvh.hierarchy import BvhJoint
from regkit.interchange.bvh.lines import Lines
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.notes import note


def read_motion(lines: Lines, joints: Sequence[BvhJoint], *, posed: bool) -> tuple[float, Array]:
    """Parses the rest of a file, and returns its frame time [s] and frames (F, C).

    Without a usable motion there are no frames, or the frame time is zero, with a note; the
    skeleton is the file's all the same. An unfinished last frame is left out.

    Args:
        lines: The lines after the hierarchy.
        joints: The joints, whose channels a frame has.
        posed: Whether the frames matter. If not, frames that cannot be read are left out.

    Raises:
        DataError: If something else follows the hierarchy, or a frame is invalid.
    """
    channels = sum(len(joint.channels) for joint in joints)
    if lines.ended:
        note("has no MOTION, only a skeleton", place=lines.place)
        return 0.0, np.zeros((0, channels))
    line = lines.take("MOTION")
    if line.upper() != "MOTION":
        raise lines.wrong(f"'{line[:40]}' where MOTION is expected")
    try:
        announced, frame_time = lines.field("Frames"), lines.field("Frame Time")
        if frame_time is None or frame_time <= 0.0:
            note(
                f"Frame Time is {frame_time or 0.0:g}; without a positive one the frames are poses "
                "and no motion",
                place=lines.place,
            )
            frame_time = 0.0
        frames = _frames(lines, channels)
    except DataError as error:
        if posed:
            raise
        note(f"{error.message}; the frames are left out", place=error.place)
        return 0.0, np.zeros((0, channels))
    if announced != len(frames):
        stated = "nothing" if announced is None else f"{announced:g}"
        note(
            f"Frames is {stated}, and {len(frames)} frames follow, which are used",
            place=lines.place,
        )
    return frame_time, frames


def _frames(lines: Lines, channels: int) -> Array:
    frames = []
    while not lines.ended:
        line = lines.take("a frame")
        if lines.ended and frames and len(line.split()) < channels:
            note("the last frame is unfinished, and left out", place=lines.place)
            break
        frames.append(lines.numbers(line, channels, "a frame"))
    return np.array(frames, dtype=np.float64).reshape(len(frames), channels)
