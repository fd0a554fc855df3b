"""Mirror images in the plane x = 0: right from left."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from regkit.body.description import GaussianDescription
from regkit.fitting.moments import ball, clusters, spread, vector
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.skeleton import SegmentDescription
from regkit.skeleton.description import CapsuleDescription
from regkit.skeleton.joints import BallJoint, HingeJoint, Joint, UniversalJoint, Vector
from regkit.system.arrays import Array

REFLECT = np.array([-1.0, 1.0, 1.0])
"""What a point is multiplied by."""

_TURN = np.array([1.0, -1.0, -1.0])
"""What an axis or a rotation vector is multiplied by: its sense of turning is reflected, too."""


def point(value: Vector) -> Vector:
    """The mirror image of a point [m]."""
    return vector(REFLECT * value, 15)


def turn(value: Vector) -> Vector:
    """The mirror image of an axis or of a rotation vector."""
    return vector(_TURN * value, 15)


def capsule(value: CapsuleDescription) -> CapsuleDescription:
    """The mirror image of a capsule."""
    return CapsuleDescription(start=point(value.start), end=point(value.end), radius=value.radius)


def gaussian(value: GaussianDescription) -> GaussianDescription:
    """The mirror image of a Gaussian."""
    return GaussianDescription(
        centre=point(value.centre), sigma=value.sigma, rotation_deg=turn(value.rotation_deg)
    )


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
        case UniversalJoint(axes=(first, second), limits_deg=both):
            return UniversalJoint(
                type="universal", axes=(turn(first), turn(second)), limits_deg=both
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
        capsules=tuple(capsule(one) for one in value.capsules),
        markers={rename(name): point(marker) for name, marker in value.markers.items()},
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


def symmetric_balls(points: Array, pairs: int, middle: int) -> tuple[GaussianDescription, ...]:
    """Isotropic Gaussians that are their own mirror image in the plane x = 0.

    Args:
        points: (N, 3) points that are symmetric about that plane [m].
        pairs: How many pairs there are, left first.
        middle: How many lie in the plane.
    """
    half = points[points[:, 0] > 0.0]
    start = half[spread(half, pairs + middle)]
    start = start[np.argsort(-start[:, 0], kind="stable")]
    owners = clusters(half, start, in_plane=middle)
    balls: list[GaussianDescription] = []
    for index in range(pairs):
        own = half[owners == index]
        balls += [ball(own), ball(own * REFLECT)]
    for index in range(pairs, pairs + middle):
        own = half[owners == index]
        balls.append(ball(np.concatenate([own, own * REFLECT])))
    return tuple(balls)
