"""Members of a composed template: descriptions under names of their own, at sizes of their own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from regkit.body.capsules import deformed_capsule
from regkit.body.deformation import Scaling
from regkit.body.description import BodyDescription
from regkit.body.parts import PartDescription
from regkit.body.shape_keys import kind_of
from regkit.body.shape_parameters import ShapeParameters
from regkit.body.shapes import ParametricShape
from regkit.skeleton import PoseDescription, SegmentDescription
from regkit.skeleton.description import parents_first
from regkit.skeleton.joints import HingeJoint, Joint, PrismaticJoint
from regkit.skeleton.pose import JointAngles, RootDescription


@dataclass(frozen=True)
class Member:
    """A description that becomes a part of a composed one.

    Attributes:
        name: Name of the part.
        description: Its own description, at its size.
        prefix: What the names of its segments and markers have before them.
        at: Name of its first segment, if it takes that of a segment that it replaces.
    """

    name: str
    description: BodyDescription
    prefix: str = ""
    at: str | None = None

    @cached_property
    def names(self) -> dict[str, str]:
        """Names of its segments in the composed description, by their own, the first one first."""
        names = {own: self.prefix + own for own in parents_first(self.description.segments)}
        return names if self.at is None else {**names, next(iter(names)): self.at}

    @property
    def root(self) -> str:
        """Name of its first segment in the composed description."""
        return next(iter(self.names.values()))

    def segments(self) -> dict[str, SegmentDescription]:
        """Returns its segments under their names in the composed description."""
        return {
            self.names[name]: segment.model_copy(
                update={
                    "parent": None if segment.parent is None else self.names[segment.parent],
                    "joint": _following(segment.joint, self.names),
                    "markers": {self.prefix + one: at for one, at in segment.markers.items()},
                }
            )
            for name, segment in self.description.segments.items()
        }

    def parts(self) -> dict[str, PartDescription]:
        """Returns itself and its own parts, under their names in the composed description."""
        own = {
            self.prefix + name: one.model_copy(update={"root": self.names[one.root]})
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
        listed = shapes.get(key) or shapes.get(kind)
        if not listed:
            listed = of_capsules(self.description.segments, kind)
        return {self.names[name]: several for name, several in listed.items()}

    def joints(self, stance: PoseDescription) -> dict[str, JointAngles]:
        """Returns the joints of one of its stances, with its root as a free joint."""
        joints = {self.names[name]: angles for name, angles in stance.joints.items()}
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
    sockets = {
        name: one.model_copy(
            update={"offset": scaling.point(one.offset), "size": scaling.radius(one.size)}
        )
        for name, one in description.sockets.items()
    }
    range_ = min(size, description.size.range[0]), max(size, description.size.range[1])
    return description.model_copy(
        update={
            "segments": segments,
            "shapes": shapes,
            "parts": parts,
            "sockets": sockets,
            "size": description.size.model_copy(update={"value": size, "range": range_}),
            "mesh": None,
        }
    )


def _following(joint: Joint | None, names: Mapping[str, str]) -> Joint | None:
    """Returns a joint whose leader, if it has one, has its new name."""
    if isinstance(joint, HingeJoint | PrismaticJoint) and joint.coupled is not None:
        coupled = joint.coupled.model_copy(update={"to": names[joint.coupled.to]})
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


def of_capsules(
    segments: Mapping[str, SegmentDescription], kind: str
) -> dict[str, tuple[ShapeParameters, ...]]:
    """Returns a primitive of a kind of shape model for each capsule, by segment."""
    made = ParametricShape.parameters_of(kind)
    if made is None:
        return {}
    return {
        name: tuple(
            made.of_capsule(np.array([one.start, one.end]), np.broadcast_to(one.radius, 2))
            for one in segment.capsules
        )
        for name, segment in segments.items()
        if segment.capsules
    }
