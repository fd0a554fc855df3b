"""Composition of templates: bodies beside each other, and parts in place of a body's segments."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeVar

import numpy as np

from regkit.body.description import BodyDescription
from regkit.body.members import Member, of_capsules
from regkit.body.parts import PartDescription, SocketDescription
from regkit.body.shape_keys import kind_of
from regkit.body.shapes import Shapes
from regkit.body.vectors import vector
from regkit.geometry.rotation import from_matrix, to_vector, vector_to_matrix
from regkit.skeleton import PoseDescription, SegmentDescription
from regkit.skeleton.joints import FixedJoint, FreeJoint
from regkit.skeleton.pose import JointAngles, RootDescription
from regkit.system.errors import ConfigError

V = TypeVar("V")

_UNMOVED = {"root": RootDescription()}

WORLD = "world"
"""Name of the fixed segment on which the bodies of a scene hang."""


def beside(members: Sequence[Member], leading: int) -> BodyDescription:
    """Returns one description of several bodies that move freely beside each other.

    They hang on a fixed segment at the world's origin. Stances of the same name are one stance of
    the whole, in which bodies without it are at rest.

    Args:
        members: The bodies.
        leading: Index of the body whose size is that of the whole.

    Raises:
        ConfigError: If two bodies have segments, markers or parts of the same name.
    """
    segments = {WORLD: SegmentDescription(joint=FixedJoint())}
    parts: dict[str, PartDescription] = {}
    stances: dict[str, dict[str, JointAngles]] = {}
    for member in members:
        own = member.segments()
        joint = own[member.root].joint
        moves = {"parent": WORLD, "joint": joint if isinstance(joint, FreeJoint) else FixedJoint()}
        own[member.root] = own[member.root].model_copy(update=moves)
        segments = united(segments, own, "segment", member.name)
        parts = united(parts, member.parts(), "part", member.name)
        for name, stance in member.description.stances.items():
            stances.setdefault(name, {}).update(member.joints(stance))
    check_markers(segments)
    return BodyDescription(
        title="; ".join(f"{one.name}: {one.description.title}" for one in members),
        sources=sources_of(members),
        size=members[leading].description.size,
        segments=segments,
        stances={name: PoseDescription(joints=joints) for name, joints in stances.items()},
        upright=all(one.description.upright for one in members),
        shapes=listed_together(members),
        parts=parts,
    )


def attached(body: Member, parts: Sequence[Member]) -> BodyDescription:
    """Returns the description of a body with parts in place of some of its segments.

    A part takes the name of the segment that it replaces (``Member.at``), and its markers beside
    its own. Joints, capsules and primitives are those of the part.

    Args:
        body: The body, which has a socket at each of the segments.
        parts: The parts.

    Raises:
        ConfigError: If two segments, markers or parts have the same name.
    """
    whole = body.description
    segments, found = dict(whole.segments), body.parts()
    for part in parts:
        own = part.segments()
        own[part.root] = _in_socket(
            own[part.root], segments.pop(part.root), whole.sockets[part.root]
        )
        segments = united(segments, own, "segment", part.name)
        found = united(found, part.parts(), "part", part.name)
    check_markers(segments)
    return BodyDescription(
        title=f"{whole.title}, with {', '.join(part.name for part in parts)}",
        sources=sources_of([body, *parts]),
        size=whole.size,
        segments=segments,
        stances=_stances_with(parts, whole.stances),
        upright=whole.upright,
        shapes=_listed_in_place(body, parts),
        parts=found,
    )


def _in_socket(
    root: SegmentDescription, replaced: SegmentDescription, socket: SocketDescription
) -> SegmentDescription:
    """Returns a part's first segment where it replaces another, whose markers it has too."""
    turned, rotation = (
        vector_to_matrix(np.radians(one)) for one in (replaced.rotation_deg, socket.rotation_deg)
    )
    markers = {
        name: vector(rotation.T @ (np.array(at) - socket.offset))
        for name, at in replaced.markers.items()
    }
    whole = np.degrees(to_vector(from_matrix(turned @ rotation)))
    return root.model_copy(
        update={
            "parent": replaced.parent,
            "offset": vector(np.array(replaced.offset) + turned @ socket.offset),
            "rotation_deg": vector(whole),
            "joint": socket.joint,
            "markers": {**markers, **root.markers},
            "optional": replaced.optional,
        }
    )


def _stances_with(
    parts: Sequence[Member], stances: Mapping[str, PoseDescription]
) -> dict[str, PoseDescription]:
    """Returns a body's stances with those of the same name of its parts, and then the others."""
    found = dict(stances)
    for part in parts:
        for name, own in part.description.stances.items():
            stance = found.get(name, PoseDescription())
            joints = stance.joints | part.joints(own.model_copy(update=_UNMOVED))
            found[name] = stance.model_copy(update={"joints": joints})
    return found


def _listed_in_place(body: Member, parts: Sequence[Member]) -> Shapes:
    """Returns the primitives of a body with parts: every list that one of them has.

    Where a list of the body has nothing at a replaced segment, the primitives of the segment before
    it stand for both; that segment's capsules take their place.
    """
    listed = listed_together([body])
    for key in listed_together(parts):
        listed.setdefault(key, body.primitives(key))
    for key, by_segment in listed.items():
        for part in parts:
            replaced = body.description.segments[part.root]
            if not by_segment.pop(part.root, ()) and replaced.parent is not None:
                before = {replaced.parent: body.description.segments[replaced.parent]}
                by_segment.update(of_capsules(before, kind_of(key)))
            by_segment.update(part.primitives(key))
    return listed


def sources_of(members: Sequence[Member]) -> tuple[str, ...]:
    """Returns the sources of all members, each once."""
    return tuple(dict.fromkeys(one for member in members for one in member.description.sources))


def united(found: Mapping[str, V], own: Mapping[str, V], what: str, part: str) -> dict[str, V]:
    """Returns both mappings in one.

    Raises:
        ConfigError: If a name is in both.
    """
    twice = next((name for name in own if name in found), None)
    if twice is not None:
        raise ConfigError(
            f"the {what} '{twice}' of '{part}' is there already; give the part another name"
        )
    return {**found, **own}


def check_markers(segments: Mapping[str, SegmentDescription]) -> None:
    """Refuses two markers of the same name.

    Raises:
        ConfigError: At the first one.
    """
    found: dict[str, None] = {}
    for name, segment in segments.items():
        found = united(found, dict.fromkeys(segment.markers), "marker", name)


def listed_together(members: Sequence[Member]) -> Shapes:
    """Returns the primitives of all members: every list that one of them has."""
    keys = dict.fromkeys(key for one in members for key in one.description.shapes)
    return {
        key: {name: several for one in members for name, several in one.primitives(key).items()}
        for key in keys
    }
