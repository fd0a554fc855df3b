"""Mirror images in the plane x = 0: right from left."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

import numpy as np

from regkit.body import Mirror, ShapeParameters
from regkit.body.capsules import deformed_capsule
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.skeleton import SegmentDescription
from regkit.skeleton.joints import (
    BallJoint,
    HingeJoint,
    Joint,
    PrismaticJoint,
    UniversalJoint,
)

_MIRROR = Mirror()
point, turn = _MIRROR.point, _MIRROR.rotation
"""The mirror images of a point [m], and of an axis or a rotation vector."""

P = TypeVar("P", bound=ShapeParameters)


def primitive(value: P) -> P:
    """The mirror image of a primitive of a shape model."""
    return value.deformed(_MIRROR)


def joint(value: Joint, rename: Callable[[str], str]) -> Joint:
    """The mirror image of a joint: the same angles bend it to the mirrored pose.

    ``rename`` names what it follows.

    A ball joint keeps its twist axis, so that its twist changes its sign.
    """
    match value:
        case HingeJoint(axis=axis, limits_deg=limits, coupled=coupled):
            if coupled is not None:
                coupled = coupled.model_copy(update={"to": rename(coupled.to)})
            return HingeJoint(type="hinge", axis=turn(axis), limits_deg=limits, coupled=coupled)
        case PrismaticJoint(axis=axis, limits=limits, coupled=slide):
            if slide is not None:
                slide = slide.model_copy(update={"to": rename(slide.to)})
            # A direction is mirrored as a point is.
            return PrismaticJoint(type="prismatic", axis=point(axis), limits=limits, coupled=slide)
        case UniversalJoint(axes=(first, second), limits_deg=both):
            return UniversalJoint(
                type="universal",
                axes=(turn(first), turn(second)),
                limits_deg=both,
            )
        case BallJoint(twist_deg=twist):
            return BallJoint(
                type="ball",
                twist_axis=value.twist_axis,
                swing_axis=turn(value.swing_axis),
                centre_deg=turn(value.centre_deg),
                swing_deg=value.swing_deg,
                twist_deg=None if twist is None else (-twist[1], -twist[0]),
            )
    return value


def segment(value: SegmentDescription, rename: Callable[[str], str]) -> SegmentDescription:
    """The mirror image of a segment; ``rename`` names what it hangs on and its markers."""
    return SegmentDescription(
        parent=None if value.parent is None else rename(value.parent),
        offset=point(value.offset),
        joint=None if value.joint is None else joint(value.joint, rename),
        capsules=tuple(deformed_capsule(one, _MIRROR) for one in value.capsules),
        markers={rename(name): point(marker) for name, marker in value.markers.items()},
        optional=value.optional,
    )


def reflected(mesh: SkinnedMesh) -> SkinnedMesh:
    """The mirror image in the plane x = 0: a left hand from a right one."""
    mirror = np.diag([-1.0, 1.0, 1.0, 1.0])
    return replace(
        mesh,
        vertices=mesh.vertices @ mirror[:3, :3],
        faces=mesh.faces[:, ::-1],
        rest=mirror @ mesh.rest @ mirror,
    )
