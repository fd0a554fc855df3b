"""Composition of templates: several bodies beside each other in one description."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from regkit.body.capsules import deformed_capsule
from regkit.body.deformation import Scaling
from regkit.body.description import BodyDescription
from regkit.body.parts import PartDescription
from regkit.body.shape_keys import kind_of
from regkit.body.shape_parameters import ShapeParameters
from regkit.body.shapes import ParametricShape, Shapes
from regkit.skeleton import PoseDescription, SegmentDescription
from regkit.skeleton.description import parents_first
from regkit.skeleton.joints import FixedJoint, FreeJoint, HingeJoint, Joint, PrismaticJoint
from regkit.skeleton.pose import JointAngles, RootDescription
from regkit.system.errors import ConfigError

V = TypeVar("V")

WORLD = "world"
"""Name of the fixed segment on which the bodies of a scene hang."""


@dataclass(frozen=True)
class Member:
    """A description that becomes a part of a composed one.

    Attributes:
        name: Name of the part.
        description: Its own description, at its size.
        prefix: What the names of its segments and markers have before them.
    """

    name: str
    description: BodyDescription
    prefix: str = ""

    @property
    def root(self) -> str:
        """Name of its first segment in the composed description."""
        return self.prefix + parents_first(self.description.segments)[0]

    def segments(self) -> dict[str, SegmentDescription]:
        """Returns its segments under their names in the composed description."""
        return {
            self.prefix + name: segment.model_copy(
                update={
                    "parent": None if segment.parent is None else self.prefix + segment.parent,
                    "joint": _following(segment.joint, self.prefix),
                    "markers": {self.prefix + one: at for one, at in segment.markers.items()},
                }
            )
            for name, segment in self.description.segments.items()
        }

    def parts(self) -> dict[str, PartDescription]:
        """Returns itself and its own parts, under their names in the composed description."""
        own = {
            self.prefix + name: one.model_copy(update={"root": self.prefix + one.root})
            for name, one in self.description.parts.items()
        }
        roots = {one.root for one in own.values()}
        whole = PartDescription(root=self.root, size=self.description.size.value)
        return own if self.root in roots else {self.name: whole, **own}

    def primitives(self, key: str) -> dict[str, tuple[ShapeParameters, ...]]:
        """Returns its primitives for a list, by segment.

        A part without the list takes its own for that kind of shape model, or its capsules.
        """
        shapes, kind = self.description.shapes, kind_of(key)
        listed = shapes.get(key) or shapes.get(kind) or _of_capsules(self.description, kind)
        return {self.prefix + name: several for name, several in listed.items()}

    def joints(self, stance: PoseDescription) -> dict[str, JointAngles]:
        """Returns the joints of one of its stances, with its root as a free joint."""
        joints = {self.prefix + name: angles for name, angles in stance.joints.items()}
        # Where the root is does not matter in a stance.
        if stance.root.rotation_deg == RootDescription().rotation_deg:
            return joints
        return {self.root: RootDescription(rotation_deg=stance.root.rotation_deg), **joints}


def scaled(description: BodyDescription, size: float) -> BodyDescription:
    """Returns a description with all lengths in proportion to a size [m].

    Its mesh, whose lengths stay, is left out.
    """
    scaling = Scaling(size / description.size.value)
    segments = {
        name: segment.model_copy(
            update={
                "offset": scaling.point(segment.offset),
                "joint": _scaled_joint(segment.joint, scaling),
                "capsules": tuple(deformed_capsule(one, scaling) for one in segment.capsules),
                "markers": {one: scaling.point(at) for one, at in segment.markers.items()},
            }
        )
        for name, segment in description.segments.items()
    }
    shapes = {
        key: {name: tuple(one.deformed(scaling) for one in several) for name, several in by.items()}
        for key, by in description.shapes.items()
    }
    parts = {
        name: one.model_copy(update={"size": scaling.radius(one.size)})
        for name, one in description.parts.items()
    }
    range_ = min(size, description.size.range[0]), max(size, description.size.range[1])
    return description.model_copy(
        update={
            "segments": segments,
            "shapes": shapes,
            "parts": parts,
            "size": description.size.model_copy(update={"value": size, "range": range_}),
            "mesh": None,
        }
    )


def beside(title: str, members: Sequence[Member], leading: int) -> BodyDescription:
    """Returns one description of several bodies that move freely beside each other.

    They hang on a fixed segment at the world's origin. Stances of the same name are one stance of
    the whole, in which bodies without it are at rest.

    Args:
        title: Description of the whole in one line.
        members: The bodies.
        leading: Index of the body whose size is that of the whole.

    Raises:
        ValidationError: If two bodies have segments, markers or parts of the same name.
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
    first = members[leading].description
    return BodyDescription(
        title=title,
        sources=tuple(dict.fromkeys(s for one in members for s in one.description.sources)),
        size=first.size,
        segments=segments,
        stances={name: PoseDescription(joints=joints) for name, joints in stances.items()},
        upright=all(one.description.upright for one in members),
        shapes=listed_together(members),
        parts=parts,
    )


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


def listed_together(members: Sequence[Member]) -> Shapes:
    """Returns the primitives of all members: every list that one of them has."""
    keys = dict.fromkeys(key for one in members for key in one.description.shapes)
    return {
        key: {name: several for one in members for name, several in one.primitives(key).items()}
        for key in keys
    }


def _following(joint: Joint | None, prefix: str) -> Joint | None:
    """Returns a joint whose leader, if it has one, has the prefix too."""
    if isinstance(joint, HingeJoint | PrismaticJoint) and joint.coupled is not None:
        coupled = joint.coupled.model_copy(update={"to": prefix + joint.coupled.to})
        return joint.model_copy(update={"coupled": coupled})
    return joint


def _scaled_joint(joint: Joint | None, scaling: Scaling) -> Joint | None:
    """Returns a joint whose displacement, if it has one, is scaled."""
    if not isinstance(joint, PrismaticJoint):
        return joint
    coupled = joint.coupled
    if coupled is not None:
        coupled = coupled.model_copy(update={"offset": scaling.radius(coupled.offset)})
    limits = tuple(map(scaling.radius, joint.limits))
    return joint.model_copy(update={"limits": limits, "coupled": coupled})


def _of_capsules(description: BodyDescription, kind: str) -> dict[str, tuple[ShapeParameters, ...]]:
    """Returns a primitive of a kind of shape model for each capsule, by segment."""
    made = ParametricShape.parameters_of(kind)
    if made is None:
        return {}
    return {
        name: tuple(
            made.of_capsule(np.array([one.start, one.end]), np.broadcast_to(one.radius, 2))
            for one in segment.capsules
        )
        for name, segment in description.segments.items()
        if segment.capsules
    }
