"""What a skeleton's YAML holds: a tree of named segments."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field, ValidationError, model_validator

from regkit.config.model import Model, did_you_mean, misplaced
from regkit.skeleton.joints import FreeJoint, HingeJoint, Joint, Vector

Radius = Annotated[float, Field(gt=0.0)]


class CapsuleDescription(Model):
    """The convex hull of two spheres, in the segment's frame."""

    start: Vector
    """Centre of the first sphere [m]."""
    end: Vector
    """Centre of the second sphere [m]; the same as the first makes one sphere."""
    radius: Radius | tuple[Radius, Radius]
    """One radius, or that of the first and of the second sphere [m]."""


class SegmentDescription(Model):
    """One rigid segment and the joint that ties it to its parent."""

    parent: str | None = None
    """Name of the parent segment; the one segment without it is the root."""
    offset: Vector = (0.0, 0.0, 0.0)
    """Position of the joint in the parent's frame [m]."""
    rotation_deg: Vector = (0.0, 0.0, 0.0)
    """Rotation vector of the joint's frame in the parent's at rest [deg]; zero: parallel."""
    joint: Joint | None = None
    """How the segment moves relative to its parent; it is fixed to it without. A root must say."""
    capsules: tuple[CapsuleDescription, ...] = ()
    """The segment's surface."""
    markers: dict[str, Vector] = Field(default_factory=dict)
    """Named points in the segment's frame [m]: joints, fingertips, whatever can be measured."""


class SkeletonDescription(Model):
    """A tree of segments; in the rest pose every joint angle is zero."""

    segments: dict[str, SegmentDescription] = Field(min_length=1)
    """The segments by name, in any order."""

    @model_validator(mode="after")
    def _is_a_tree(self) -> SkeletonDescription:
        parents_first(self.segments)
        owners: dict[str, str] = {}
        for name, segment in self.segments.items():
            for marker in segment.markers:
                if marker in owners:
                    raise _wrong(
                        f"marker '{marker}' is on '{owners[marker]}' and on '{name}'",
                        name,
                        "markers",
                        marker,
                    )
                owners[marker] = name
        _check_couplings(self.segments)
        return self


def parents_first(segments: dict[str, SegmentDescription]) -> list[str]:
    """The names ordered so that each parent comes before its children.

    Raises:
        ValidationError: If there is not exactly one root, a parent is unknown, the tree has a
            cycle, the root has no joint, or another segment's joint is free.
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
        if segment.parent is not None and isinstance(segment.joint, FreeJoint):
            raise _wrong(f"segment '{name}' has a free joint; only the root may", name, "joint")
    for name in roots:
        if segments[name].joint is None:
            raise _wrong(
                f"the root '{name}' has no joint; write joint: {{type: free}}, or fixed if it "
                "rests",
                name,
            )
    if len(roots) > 1:
        raise _wrong(
            f"several segments have no parent ({', '.join(roots)}); one root is needed", roots[1]
        )
    ordered = list(roots)
    for name in ordered:
        ordered += [child for child, segment in segments.items() if segment.parent == name]
    cyclic = [name for name in segments if name not in ordered]
    if cyclic:
        raise _wrong(
            f"the segments {', '.join(cyclic)} form a cycle; following their parents must end at "
            "the root",
            cyclic[0],
            "parent",
        )
    return ordered


def _check_couplings(segments: dict[str, SegmentDescription]) -> None:
    """A leader is another hinge that follows none, and has angles that suit all its followers."""
    hinges = {n: s.joint for n, s in segments.items() if isinstance(s.joint, HingeJoint)}
    leaders = [name for name, hinge in hinges.items() if hinge.coupled is None]
    left: dict[str, tuple[float, float]] = {}
    for name, follower in hinges.items():
        if follower.coupled is None:
            continue
        to = follower.coupled.to
        if to not in leaders:
            reason = f"'{to}' follows another itself" if to in hinges else f"'{to}' is no hinge"
            reason = "a hinge cannot follow itself" if to == name else reason
            raise _wrong(
                f"{reason}; '{name}' can follow a hinge that follows none "
                f"(there are: {', '.join(leaders)})" + did_you_mean(to, leaders),
                *(name, "joint", "coupled", "to"),
            )
        low, high = left.get(to, hinges[to].limits_deg or (-np.inf, np.inf))
        own = follower.limits_deg or (-np.inf, np.inf)
        ratio, offset = follower.coupled.ratio, follower.coupled.offset_deg
        ends = sorted((end - offset) / ratio for end in own)
        left[to] = max(low, ends[0]), min(high, ends[1])
        if left[to][0] > left[to][1]:
            raise _wrong(
                f"no angle of '{to}' keeps all limits: '{name}' needs it between {ends[0]:g} and "
                f"{ends[1]:g} degrees, and its own limits and what else follows it leave "
                f"{low:g} to {high:g}",
                *(name, "joint", "coupled"),
            )


def _wrong(message: str, *location: str) -> ValidationError:
    return misplaced(SkeletonDescription, message, "segments", *location)
