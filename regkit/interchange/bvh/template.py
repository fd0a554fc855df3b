"""Templates from BVH skeletons."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from regkit.interchange.bvh.bvh import Bvh
from regkit.interchange.bvh.hierarchy import BvhJoint
from regkit.interchange.imported import MIN_LENGTH, Bone, ImportedSkeleton, ball, vector
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
"""Range of the size relative to the skeleton's own, for other people with the same skeleton."""

MAX_TRANSLATION = 1e-3
"""Largest motion along the position channels of a joint that counts as fixed [m]."""


def bvh_template(motion: Bvh, path: Path, title: str, axes: Array) -> ImportedSkeleton:
    """Returns the template of a motion, with a segment for each joint and markers at all ends.

    A joint with three rotation channels becomes a ball joint, with two a universal joint, with one
    a hinge. The format has no limits and no shapes.

    Args:
        motion: The motion.
        path: The file.
        title: Title of the template.
        axes: ``R_body_file``, (3, 3).

    Raises:
        DataError: If a joint other than the root moves along a position channel.
    """
    names = set(motion.names)
    bones = []
    for index, joint in enumerate(motion.joints):
        sites = {_end_name(joint.name, k, names): end for k, end in enumerate(joint.ends)}
        markers = {joint.name: np.zeros(3)} | {name: axes @ end for name, end in sites.items()}
        ends = [*(other.offset for other in motion.joints if other.parent == index), *joint.ends]
        bone = next((axes @ end for end in ends if np.linalg.norm(end) > MIN_LENGTH), None)
        own = FreeJoint() if index == 0 else _joint(joint, axes, bone)
        offset = np.zeros(3) if index == 0 else axes @ _fixed_offset(motion, index, path)
        bones.append(Bone(joint.name, joint.parent, offset, own, None, markers))
    return ImportedSkeleton.of(bones, path, title, spread=SPREAD)


def _joint(joint: BvhJoint, axes: Array, bone: Array | None) -> Joint:
    letters = [name[0] for name in joint.channels if name.endswith("rotation")]
    about = [vector(axes[:, "XYZ".index(letter)]) for letter in letters]
    if len(about) == 3:
        return ball(bone)
    if len(about) == 2:
        return UniversalJoint(type="universal", axes=(about[0], about[1]))
    if about:
        return HingeJoint(type="hinge", axis=about[0])
    return FixedJoint()


def _fixed_offset(motion: Bvh, index: int, path: Path) -> Array:
    """Returns the constant position of a joint relative to its parent, (3,) [m].

    Raises:
        DataError: If the position changes over time.
    """
    joint = motion.joints[index]
    places = motion.offsets(index)
    moves = np.ptp(places, axis=0).max(initial=0.0) if len(places) else 0.0
    if moves > MAX_TRANSLATION:
        raise DataError(
            f"the joint '{joint.name}' moves by {moves:.3g} m along its position channels; the "
            "joints of a template can only rotate",
            place=str(path),
        )
    return np.asarray(places.mean(axis=0) if len(places) else joint.offset)


def _end_name(joint: str, number: int, taken: set[str]) -> str:
    name = f"{joint}_end" if number == 0 else f"{joint}_end_{number + 1}"
    while name in taken:
        name += "_"
    taken.add(name)
    return name
