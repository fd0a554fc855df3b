"""The skeleton of a BVH file as a template."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from regkit.interchange.bvh.bvh import Bvh
from regkit.interchange.bvh.hierarchy import BvhJoint
from regkit.interchange.imported import SHORTEST, Bone, ImportedSkeleton, ball, vector
from regkit.skeleton.joints import (
    FixedJoint,
    FreeJoint,
    HingeJoint,
    Joint,
    UniversalJoint,
)
from regkit.system.arrays import Array
from regkit.system.errors import DataError

SPREAD = (0.8, 1.25)
"""Others that move alike are so much smaller or larger."""

HELD = 1e-3
"""A joint that moves by less along its position channels is held by its bone [m]."""


def bvh_template(motion: Bvh, path: Path, title: str, axes: Array) -> ImportedSkeleton:
    """The skeleton of a motion: a segment for each joint, a marker at each joint and end.

    Three rotation channels make a ball joint, two a universal one, one a hinge. The format has no
    limits and no shapes.

    Args:
        motion: The file's content.
        path: The file.
        title: What it is, in a line.
        axes: ``R_body_file``, (3, 3).

    Raises:
        DataError: If a joint below the root moves along a position channel.
    """
    names = set(motion.names)
    bones = []
    for index, joint in enumerate(motion.joints):
        ends = {_end_name(joint.name, k, names): end for k, end in enumerate(joint.ends)}
        markers = {joint.name: np.zeros(3)} | {name: axes @ end for name, end in ends.items()}
        ways = [*(other.offset for other in motion.joints if other.parent == index), *joint.ends]
        way = next((axes @ way for way in ways if np.linalg.norm(way) > SHORTEST), None)
        own = FreeJoint() if index == 0 else _joint(joint, axes, way)
        offset = np.zeros(3) if index == 0 else axes @ _held(motion, index, path)
        bones.append(Bone(joint.name, joint.parent, offset, own, None, markers))
    return ImportedSkeleton.of(bones, path, title, spread=SPREAD)


def _joint(joint: BvhJoint, axes: Array, way: Array | None) -> Joint:
    turned = [name[0] for name in joint.channels if name.endswith("rotation")]
    about = [vector(axes[:, "XYZ".index(letter)]) for letter in turned]
    if len(about) == 3:
        return ball(way)
    if len(about) == 2:
        return UniversalJoint(type="universal", axes=(about[0], about[1]))
    if about:
        return HingeJoint(type="hinge", axis=about[0])
    return FixedJoint()


def _held(motion: Bvh, index: int, path: Path) -> Array:
    """Where a joint is in its parent's frame, (3,) [m].

    Raises:
        DataError: If it moves there.
    """
    joint = motion.joints[index]
    places = motion.offsets(index)
    moves = np.ptp(places, axis=0).max(initial=0.0) if len(places) else 0.0
    if moves > HELD:
        raise DataError(
            f"the joint '{joint.name}' moves by {moves:.3g} m along its position channels; "
            "a template's joints only turn",
            place=str(path),
        )
    return np.asarray(places.mean(axis=0) if len(places) else joint.offset)


def _end_name(joint: str, number: int, taken: set[str]) -> str:
    name = f"{joint}_end" if number == 0 else f"{joint}_end_{number + 1}"
    while name in taken:
        name += "_"
    taken.add(name)
    return name
