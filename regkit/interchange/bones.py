"""The bones of other programs' skeletons, and the capsules of those without a shape."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from regkit.skeleton.description import CapsuleDescription
from regkit.skeleton.joints import BallJoint, Joint, Vector
from regkit.system.arrays import Array
from regkit.system.errors import DataError

THICKNESS = 0.15
"""Radius of the capsule of a bone without a shape, as a fraction of its length."""

MIN_THICKNESS = 0.005
"""Minimum radius of such a capsule, as a fraction of the skeleton's largest extent."""

MIN_LENGTH = 1e-4
"""Minimum length of a bone [m]."""

MOST = 1000
"""Largest number of bones; a body with a hand's or face's details has a few hundred."""


@dataclass(frozen=True)
class Bone:
    """A bone whose frame at rest is parallel to the body frame.

    Attributes:
        name: Name of the bone.
        parent: Index of its parent, which comes before it; -1 for the root.
        offset: Position of its joint relative to its parent's, (3,) [m].
        joint: The joint; free for the root.
        capsules: The shape; None to generate capsules along the bone.
        markers: Markers by name, (3,) [m].
        comment: Comment on the joint in the template.
    """

    name: str
    parent: int
    offset: Array
    joint: Joint
    capsules: tuple[CapsuleDescription, ...] | None
    markers: Mapping[str, Array] = field(default_factory=dict)
    comment: str = ""


def check_count(count: int, path: Path) -> None:
    """Checks the number of a skeleton's bones.

    Raises:
        DataError: If a template cannot have so many.
    """
    if count > MOST:
        raise DataError(
            f"the skeleton has {count} joints; a template can have {MOST}", place=str(path)
        )


def offsets_of(bones: list[Bone]) -> list[list[Array]]:
    """Returns for each bone the vectors (3,) [m] to its children and its other markers."""
    ends: list[list[Array]] = [[] for _ in bones]
    for bone in bones:
        if bone.parent >= 0:
            ends[bone.parent].append(bone.offset)
    offsets: list[list[Array]] = []
    for bone, own in zip(bones, ends, strict=True):
        found = [np.zeros(3)]
        for offset in (*own, *bone.markers.values()):
            # Several children may have the same position.
            if np.linalg.norm(np.array(found) - offset, axis=1).min() > MIN_LENGTH:
                found.append(offset)
        offsets.append(found[1:])
    return offsets


def generated_capsules(offsets: list[Array], min_radius: float) -> tuple[CapsuleDescription, ...]:
    """Returns a capsule along each of a bone's offsets (3,) [m], at least ``min_radius`` [m]."""
    return tuple(
        CapsuleDescription(
            start=(0.0, 0.0, 0.0),
            end=vector(offset),
            radius=max(THICKNESS * float(np.linalg.norm(offset)), min_radius),
        )
        for offset in offsets
    )


def origins_of(bones: list[Bone]) -> Array:
    """Returns the positions of all joints at rest, (S, 3) [m]."""
    places: list[Array] = []
    for bone in bones:
        places.append(bone.offset + (places[bone.parent] if bone.parent >= 0 else 0.0))
    return np.array(places).reshape(-1, 3)


def extents_of(bones: list[Bone]) -> Array:
    """Returns the extents (3,) [m] of all joints, markers and capsules at rest."""
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for bone, place in zip(bones, origins_of(bones), strict=True):
        for capsule in bone.capsules or ():
            radii = np.broadcast_to(capsule.radius, 2)
            for end, radius in zip((capsule.start, capsule.end), radii, strict=True):
                low = np.minimum(low, place + np.array(end) - radius)
                high = np.maximum(high, place + np.array(end) + radius)
        for point in (np.zeros(3), *bone.markers.values()):
            low, high = np.minimum(low, place + point), np.maximum(high, place + point)
    return np.asarray(high - low)


def ball(bone: Array | None) -> BallJoint:
    """Returns an unlimited ball joint with the twist axis nearest to the bone (3,); y if None."""
    along = np.array([0.0, 1.0, 0.0]) if bone is None else bone
    axis = int(np.argmax(np.abs(along)))
    twist = np.copysign(np.eye(3)[axis], along) * np.eye(3)[axis]
    return BallJoint(
        type="ball",
        twist_axis=vector(twist + 0.0),
        swing_axis=vector(np.eye(3)[1 if axis == 0 else 0]),
    )


def vector(numbers: Array) -> Vector:
    """Returns an array (3,) as a tuple of floats."""
    x, y, z = (float(number) for number in numbers)
    return (x, y, z)
