"""The YAML description of a skeleton: a tree of named segments."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import numpy as np
from pydantic import AfterValidator, Field, ValidationError, model_validator

from regkit.config.model import Model, did_you_mean, misplaced
from regkit.config.quantities import Length
from regkit.skeleton.joints import (
    HingeJoint,
    Joint,
    Position,
    PrismaticJoint,
    Rotation,
)
from regkit.system.printable import is_name, shortened


class CapsuleDescription(Model):
    """A tapered capsule, the convex hull of two spheres, in the segment's frame."""

    start: Position
    """Centre of the first sphere [m]."""
    end: Position
    """Centre of the second sphere [m]; equal to ``start`` it makes a single sphere."""
    radius: Length | tuple[Length, Length]
    """Radius of both spheres, or the radii of the first and the second [m]."""


def _printable(name: str) -> str:
    if not is_name(name):
        raise ValueError(f"the name '{shortened(name)}' cannot be printed")
    return name


Name = Annotated[str, AfterValidator(_printable)]
"""Name of a segment or a marker."""


class SegmentDescription(Model):
    """One rigid segment and the joint that connects it to its parent."""

    parent: str | None = None
    """Name of the parent segment; exactly one segment, the root, has none."""
    offset: Position = (0.0, 0.0, 0.0)
    """Position of the joint in the parent's frame [m]."""
    rotation_deg: Rotation = (0.0, 0.0, 0.0)
    """Rotation vector of the joint's frame in the parent's frame at rest [deg]."""
    joint: Joint | None = None
    """Joint to the parent, fixed by default; for the root, which must name it, to the world. A free
    joint of another segment makes it the root of a body of its own."""
    capsules: tuple[CapsuleDescription, ...] = ()
    """Capsules that approximate the segment's surface."""
    markers: dict[Name, Position] = Field(default_factory=dict)
    """Named points in the segment's frame [m], such as joints or fingertips."""
    optional: bool = False
    """Whether the data may lack the segment: it explains data that are there, and where none are it
    costs nothing, like the forearm of a hand that may be cut off anywhere."""


class SkeletonDescription(Model):
    """A tree of segments. All joint angles are zero in the rest pose."""

    segments: dict[Name, SegmentDescription] = Field(min_length=1)
    """The segments by name, in any order."""

    @model_validator(mode="after")
    def _is_a_tree(self) -> SkeletonDescription:
        parents_first(self.segments)
        owners: dict[str, str] = {}
        for name, segment in self.segments.items():
            for marker in segment.markers:
                if marker in owners:
                    raise _wrong(
                        f"marker '{marker}' is on '{owners[marker]}' and on '{name}'; marker names "
                        "must be unique",
                        name,
                        "markers",
                        marker,
                    )
                owners[marker] = name
        _check_couplings(self.segments)
        for name, segment in self.segments.items():
            if segment.parent is None and segment.optional:
                raise _wrong("the root cannot be optional", name, "optional")
        return self


def parents_first(segments: dict[str, SegmentDescription]) -> list[str]:
    """Returns the segment names with each parent before its children.

    Raises:
        ValidationError: If there is not exactly one root, a parent is unknown, the tree has a
            cycle, or the root has no joint.
    """
    roots = [name for name, segment in segments.items() if segment.parent is None]
    for name, segment in segments.items():
        if segment.parent is not None and segment.parent not in segments:
            raise _wrong(
                f"segment '{name}' is an orphan: its parent '{segment.parent}' is not a segment "
                f"(there are: {', '.join(segments)})"
                + did_you_mean(segment.parent, list(segments)),
                name,
                "parent",
            )
    for name in roots:
        if segments[name].joint is None:
            raise _wrong(
                f"the root '{name}' has no joint; write joint: {{type: free}}, or {{type: fixed}} "
                "if it does not move",
                name,
            )
    if len(roots) > 1:
        raise _wrong(
            f"several segments have no parent ({', '.join(roots)}); one root is needed", roots[1]
        )
    children: dict[str | None, list[str]] = {}
    for name, segment in segments.items():
        children.setdefault(segment.parent, []).append(name)
    ordered = list(roots)
    for name in ordered:
        ordered += children.get(name, [])
    reached = set(ordered)
    cyclic = [name for name in segments if name not in reached]
    if cyclic:
        raise _wrong(
            f"the segments {', '.join(cyclic)} form a cycle; following their parents must end at "
            "the root",
            cyclic[0],
            "parent",
        )
    return ordered


def _check_couplings(segments: dict[str, SegmentDescription]) -> None:
    """Checks that leaders are independent joints whose limits are compatible with all followers."""
    hinges, slides = {}, {}
    for name, segment in segments.items():
        match segment.joint:
            case HingeJoint(limits_deg=limits, coupled=turn):
                own = None if turn is None else (turn.to, turn.ratio, turn.offset_deg)
                hinges[name] = _Axis(limits or (-np.inf, np.inf), own)
            case PrismaticJoint(limits=travel, coupled=slide):
                own = None if slide is None else (slide.to, slide.ratio, slide.offset)
                slides[name] = _Axis(travel, own)
    _check_coupled("hinge", "degrees", hinges)
    _check_coupled("prismatic joint", "metres", slides)


class _Axis(NamedTuple):
    """A joint with one axis: its limits, and the leader, ratio and offset of its coupling."""

    limits: tuple[float, float]
    coupled: tuple[str, float, float] | None


def _check_coupled(kind: str, unit: str, joints: dict[str, _Axis]) -> None:
    """Checks the couplings of all joints of one kind, which follow only each other."""
    leaders = [name for name, joint in joints.items() if joint.coupled is None]
    remaining: dict[str, tuple[float, float]] = {}
    for name, follower in joints.items():
        if follower.coupled is None:
            continue
        to, ratio, offset = follower.coupled
        if to not in leaders:
            reason = f"'{to}' is itself coupled" if to in joints else f"'{to}' is not a {kind}"
            reason = f"a {kind} cannot follow itself" if to == name else reason
            raise _wrong(
                f"{reason}; '{name}' can follow an independent {kind} "
                f"(there are: {', '.join(leaders) or 'none'})" + did_you_mean(to, leaders),
                *(name, "joint", "coupled", "to"),
            )
        low, high = remaining.get(to, joints[to].limits)
        ends = sorted((end - offset) / ratio for end in follower.limits)
        remaining[to] = max(low, ends[0]), min(high, ends[1])
        if remaining[to][0] > remaining[to][1]:
            raise _wrong(
                f"no position of '{to}' satisfies all limits: '{name}' needs it between "
                f"{ends[0]:g} and {ends[1]:g} {unit}, but its own limits and its other followers "
                f"allow only {low:g} to {high:g}",
                *(name, "joint", "coupled"),
            )


def _wrong(message: str, *location: str) -> ValidationError:
    return misplaced(SkeletonDescription, message, "segments", *location)
