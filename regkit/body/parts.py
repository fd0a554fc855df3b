"""Parts of a composed body: a person, their hands, an object in one of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from regkit.config.model import Model, did_you_mean, misplaced
from regkit.config.quantities import Length
from regkit.skeleton import SegmentDescription, Skeleton
from regkit.skeleton.joints import FixedJoint, Joint, Position, Rotation
from regkit.system.arrays import Indices
from regkit.system.brief import Brief


class PartDescription(Model):
    """A part of a template: a segment and all that hangs on it, except for other parts."""

    root: str
    """Name of the part's first segment."""
    size: Length
    """Characteristic length of the part at the template's size [m]."""


class SocketDescription(Model):
    """The place of a part that replaces a segment, such as a hand with fingers a hand without."""

    offset: Position = (0.0, 0.0, 0.0)
    """Origin of the part's first segment in the replaced segment's frame [m]."""
    rotation_deg: Rotation = (0.0, 0.0, 0.0)
    """Rotation vector of the part's first segment in the replaced segment's frame [deg]."""
    joint: Joint = FixedJoint()
    """Joint between the part and the segment before it, in the part's frame."""
    size: Length
    """Characteristic length of a part that belongs to a body of the template's size [m]."""


@dataclass(frozen=True)
class Part(Brief):
    """A part of a composed body.

    Attributes:
        name: Its name.
        segments: Indices of its segments, its root first, (P,).
        dofs: Indices of the degrees of freedom of its joints, (d,); a part that is attached to
            another owns the joint between them.
        free: Whether it moves freely in the world, and is not attached to another part.
        size: Its characteristic length, such as a hand's length [m].
    """

    name: str
    segments: Indices
    dofs: Indices
    free: bool
    size: float


def parts_of(
    skeleton: Skeleton, described: Mapping[str, PartDescription], scale: float
) -> tuple[Part, ...]:
    """Returns the parts of a skeleton whose lengths are multiplied by a scale."""
    owners = np.full(len(skeleton.names), -1)
    roots = [skeleton.names.index(part.root) for part in described.values()]
    for segment, parent in enumerate(skeleton.parents):
        # Parents come first.
        above = owners[parent] if parent >= 0 else -1
        owners[segment] = roots.index(segment) if segment in roots else above
    parts = []
    for index, (name, part) in enumerate(described.items()):
        segments = np.flatnonzero(owners == index)
        joints = [skeleton.joint_dofs.get(skeleton.names[one], ()) for one in segments]
        at_root = skeleton.free and roots[index] == 0
        dofs = np.concatenate([np.arange(6 if at_root else 0), *joints]).astype(np.intp)
        free = at_root or skeleton.is_free(part.root)
        parts.append(Part(name, segments, dofs, free, scale * part.size))
    return tuple(parts)


def check_parts(
    model: type[Model],
    segments: Mapping[str, SegmentDescription],
    parts: Mapping[str, PartDescription],
    sockets: Mapping[str, SocketDescription],
) -> None:
    """Refuses parts and sockets without a segment, and two parts with the same one.

    Args:
        model: The template's class, for the error.
        segments: Its segments.
        parts: Its parts.
        sockets: Its sockets.

    Raises:
        ValidationError: At the first wrong part.
    """
    roots: dict[str, str] = {}
    for name, part in parts.items():
        place = ("parts", name, "root")
        _check_segment(model, part.root, segments, *place)
        if part.root in roots:
            raise misplaced(
                model, f"'{part.root}' is the root of '{roots[part.root]}' already", *place
            )
        roots[part.root] = name
    for name in sockets:
        _check_segment(model, name, segments, "sockets", name)
        if segments[name].parent is None or any(one.parent == name for one in segments.values()):
            raise misplaced(
                model,
                f"'{name}' is not at the end of a limb; only such a segment can be replaced",
                *("sockets", name),
            )


def _check_segment(
    model: type[Model], name: str, segments: Mapping[str, SegmentDescription], *place: str
) -> None:
    if name not in segments:
        known = list(segments)
        raise misplaced(
            model,
            f"'{name}' is not a segment (there are: {', '.join(known)})"
            + did_you_mean(name, known),
            *place,
        )
