"""Skeletons of other programs as templates: what their formats have in common."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from pydantic import ValidationError

from regkit.body import BodyDescription
from regkit.body.description import SizeDescription
from regkit.skeleton import SegmentDescription
from regkit.skeleton.description import CapsuleDescription
from regkit.skeleton.joints import BallJoint, Joint, Vector
from regkit.system.arrays import Array
from regkit.system.errors import DataError

THICKNESS = 0.15
"""A bone without a shape gets a capsule whose radius is this part of its length."""

THINNEST = 0.005
"""No such radius is less than this part of the skeleton's largest extent."""

SHORTEST = 1e-4
"""What is shorter is no bone [m]."""

UPRIGHT = 0.8
"""The size is the height if that is at least this part of the largest extent."""


@dataclass(frozen=True)
class Bone:
    """A rigid part, in axes that are the body's for all bones where no joint is turned.

    Attributes:
        name: Its name.
        parent: Index of its parent, which stands before it; -1 for the root.
        offset: (3,) of its joint from its parent's [m].
        joint: How it moves; that of the root is set free.
        capsules: Its shape; None if a shape is to be made along the bone.
        markers: Points by name, (3,) [m].
        comment: What to say of its joint.
    """

    name: str
    parent: int
    offset: Array
    joint: Joint
    capsules: tuple[CapsuleDescription, ...] | None
    markers: Mapping[str, Array] = field(default_factory=dict)
    comment: str = ""


@dataclass(frozen=True)
class ImportedSkeleton:
    """A skeleton as a template.

    Attributes:
        description: The template.
        comments: What to say of each joint, by its segment.
        shaped: How many bones got a capsule along them, as the file has no shape that is read.
    """

    description: BodyDescription
    comments: Mapping[str, str]
    shaped: int

    @classmethod
    def of(
        cls, bones: list[Bone], path: Path, title: str, *, spread: tuple[float, float]
    ) -> ImportedSkeleton:
        """The template of a file's bones.

        Args:
            bones: The bones, parents first.
            path: The file, for messages and as the source.
            title: What it is, in a line.
            spread: By how much others of its kind are smaller and larger.

        Raises:
            DataError: If the bones are no template.
        """
        extents = _extents(bones)
        ways = [_ways(bones, index) for index in range(len(bones))]
        thinnest = THINNEST * float(extents.max())
        segments = {}
        for index, bone in enumerate(bones):
            made = bone.capsules is None
            capsules = _along(ways[index], thinnest) if made else bone.capsules
            segments[bone.name] = SegmentDescription(
                parent=bones[bone.parent].name if bone.parent >= 0 else None,
                offset=vector(bone.offset),
                joint=bone.joint,
                capsules=capsules or (),
                markers={name: vector(point) for name, point in bone.markers.items()},
            )
        upright = extents[1] >= UPRIGHT * extents.max()
        size = round(float(extents[1] if upright else extents.max()), 4)
        if size <= 0.0:
            raise DataError(
                "the skeleton has no extent: all of it is in one place", place=str(path)
            )
        try:
            description = BodyDescription(
                title=title,
                sources=(f"Skeleton: imported from {path.name}",),
                size=SizeDescription(
                    name="height" if upright else "length",
                    value=size,
                    range=(spread[0] * size, spread[1] * size),
                ),
                segments=segments,
            )
        except ValidationError as error:
            problem = error.errors(include_url=False)[0]
            where = ".".join(str(part) for part in problem["loc"])
            message = problem["msg"].removeprefix("Value error, ")
            raise DataError(f"{where}: {message}", place=str(path)) from None
        shaped = sum(bone.capsules is None and bool(segments[bone.name].capsules) for bone in bones)
        comments = {bone.name: bone.comment for bone in bones if bone.comment}
        return cls(description, comments, shaped)


def _ways(bones: list[Bone], index: int) -> list[Array]:
    """From a bone's joint to those of its children, and to its other markers, (3,) each."""
    children = [bone.offset for bone in bones if bone.parent == index]
    ways: list[Array] = []
    for way in (*children, *bones[index].markers.values()):
        # Several children may be at one place.
        if min(float(np.linalg.norm(way - other)) for other in (np.zeros(3), *ways)) > SHORTEST:
            ways.append(way)
    return ways


def _along(ways: list[Array], thinnest: float) -> tuple[CapsuleDescription, ...]:
    return tuple(
        CapsuleDescription(
            start=(0.0, 0.0, 0.0),
            end=vector(way),
            radius=max(THICKNESS * float(np.linalg.norm(way)), thinnest),
        )
        for way in ways
    )


def _extents(bones: list[Bone]) -> Array:
    """The extents (3,) of all joints, markers and capsules where no joint is turned [m]."""
    places: list[Array] = []
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for bone in bones:
        place = bone.offset + (places[bone.parent] if bone.parent >= 0 else 0.0)
        places.append(place)
        for capsule in bone.capsules or ():
            radii = np.broadcast_to(capsule.radius, 2)
            for end, radius in zip((capsule.start, capsule.end), radii, strict=True):
                low = np.minimum(low, place + np.array(end) - radius)
                high = np.maximum(high, place + np.array(end) + radius)
        for point in (np.zeros(3), *bone.markers.values()):
            low, high = np.minimum(low, place + point), np.maximum(high, place + point)
    return np.asarray(high - low)


def ball(bone: Array | None) -> BallJoint:
    """A ball joint without limits, whose twist is about the axis nearest to the bone (3,)."""
    along = np.array([0.0, 1.0, 0.0]) if bone is None else bone
    axis = int(np.argmax(np.abs(along)))
    twist = np.copysign(np.eye(3)[axis], along) * np.eye(3)[axis]
    return BallJoint(
        type="ball",
        twist_axis=vector(twist + 0.0),
        swing_axis=vector(np.eye(3)[1 if axis == 0 else 0]),
    )


def vector(numbers: Array) -> Vector:
    """Three numbers as a description has them."""
    x, y, z = (float(number) for number in numbers)
    return (x, y, z)
