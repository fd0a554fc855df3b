"""Templates from BVH skeletons."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from regkit.interchange.bones import MIN_LENGTH, Bone, ball, check_count, vector
from regkit.interchange.bvh.bvh import Bvh
from regkit.interchange.bvh.hierarchy import BvhJoint, children_of
from regkit.interchange.bvh.root import STILL, BvhRoot, movement
from regkit.interchange.imported import ImportedSkeleton
from regkit.interchange.remarks import Remarks
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

LOOSE = 0.1
"""A joint that moves along its position channels by more, relative to the skeleton's extent, is not
part of a body whose joints rotate."""


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
        DataError: If there are too many joints, or one other than the root moves far along its
            position channels.
    """
    check_count(len(motion.joints), path)
    root = BvhRoot.of(motion, path)
    place_of = {member: place for place, member in enumerate(root.members)}
    axes = axes @ root.axes
    names, children = set(motion.names), children_of(motion.joints)
    remarks = Remarks()
    bones = []
    for index in root.members:
        joint, top = motion.joints[index], index == root.members[0]
        sites = {_end_name(joint.name, k, names): end for k, end in enumerate(joint.ends)}
        markers = {joint.name: np.zeros(3)} | {name: axes @ end for name, end in sites.items()}
        ends = [*(motion.joints[child].offset for child in children[index]), *joint.ends]
        bone = next((axes @ end for end in ends if np.linalg.norm(end) > MIN_LENGTH), None)
        own = FreeJoint() if top else _joint(joint, axes, bone)
        offset = np.zeros(3) if top else axes @ _mean_offset(motion, index, path, remarks)
        parent = -1 if top else place_of[joint.parent]
        bones.append(Bone(joint.name, parent, offset, own, None, markers))
    remarks.tell()
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


def _mean_offset(motion: Bvh, index: int, path: Path, remarks: Remarks) -> Array:
    """Returns the mean position of a joint relative to its parent, (3,) [m].

    Raises:
        DataError: If the position changes too much over time.
    """
    joint = motion.joints[index]
    moved = movement(motion, index)
    if moved > LOOSE:
        raise DataError(
            f"the joint '{joint.name}' moves by {100.0 * moved:.3g} % of the skeleton's extent "
            "along its position channels; the joints of a template can only rotate",
            place=str(path),
        )
    if moved > STILL:
        remarks.add(
            "joints move along their position channels, and stay at their mean positions",
            f"{joint.name}: {100.0 * moved:.2g} % of the extent",
            str(path),
        )
    places = motion.offsets(index)
    return np.asarray(places.mean(axis=0) if len(places) else joint.offset)


def _end_name(joint: str, number: int, taken: set[str]) -> str:
    name = f"{joint}_end" if number == 0 else f"{joint}_end_{number + 1}"
    while name in taken:
        name += "_"
    taken.add(name)
    return name
