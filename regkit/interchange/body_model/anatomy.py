"""Limits and stances of human body models, whose rest pose is a T-pose.

The ranges are those of a standing person's joints, counted from arms that hang down (AAOS, in
Norkin & White, Measurement of Joint Motion; knee: Hemmerich et al., J. Orthop. Res., 2006; trunk,
neck, hip, ankle: clinical reference ranges), divided over the joints of a spine and widened for the
joints of a shoulder and a wrist, which move together. x points to the body's left, y up, z to the
front.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from regkit.geometry.rotation import from_vector, product, to_vector
from regkit.interchange.body_model.joints import FAMILIES, HUMAN
from regkit.interchange.bones import vector
from regkit.skeleton import PoseDescription
from regkit.skeleton.joints import BallJoint, Vector

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


class _Range(NamedTuple):
    """The limits of a joint on the left side or in the middle, in degrees."""

    twist_axis: Vector
    swing_axis: Vector
    centre: Vector
    swing: tuple[float, float]
    twist: float


def _from_hanging(x: float, y: float, z: float) -> Vector:
    """Returns the rotation of a left arm in the T-pose that is one of an arm that hangs down."""
    raised = from_vector(np.radians([0.0, 0.0, -90.0]))
    turned = product(from_vector(np.radians([x, y, z])), raised)
    return vector(np.degrees(to_vector(turned)).round(1) + 0.0)


_FINGER = _Range(X, Z, (0, 0, -35), (65, 20), 15)
_KNUCKLE = _Range(X, Z, (0, 0, -45), (60, 10), 10)
_SPINE = _Range(Y, X, (10, 0, 0), (30, 20), 20)
_NECK = _Range(Y, X, (0, 0, 0), (30, 30), 40)
_EYE = _Range(Z, X, (0, 0, 0), (35, 35), 10)

_RANGES = {
    "spine1": _SPINE,
    "spine2": _SPINE,
    "spine3": _SPINE,
    "neck": _NECK,
    "head": _NECK,
    "jaw": _Range(Z, X, (15, 0, 0), (20, 10), 10),
    "eye": _EYE,
    "collar": _Range(X, Z, (0, 0, 0), (30, 30), 20),
    "shoulder": _Range(X, (0, -(0.5**0.5), 0.5**0.5), _from_hanging(-53, 0, 53), (120, 105), 90),
    # The forearm bends to the front, and its turn about its length is that of the elbow and the
    # wrist together.
    "elbow": _Range(X, Y, (0, -75, 0), (80, 15), 90),
    "wrist": _Range(X, Z, (0, 0, 0), (80, 35), 60),
    "hand": _Range(X, Z, (0, 0, -15), (30, 10), 10),
    "hip": _Range(Y, X, (-45, 0, 7.5), (75, 45), 45),
    "knee": _Range(Y, X, (75, 0, 0), (82, 10), 20),
    "ankle": _Range(Y, X, (15, 0, -10), (35, 25), 25),
    "foot": _Range(Y, X, (-15, 0, 0), (45, 10), 10),
    **dict.fromkeys(("index1", "middle1", "ring1", "pinky1"), _FINGER),
    **{f"{finger}{n}": _KNUCKLE for finger in ("index", "middle", "ring", "pinky") for n in (2, 3)},
    **{f"thumb{n}": _Range(X, Z, (0, 0, 0), (60, 60), 40) for n in (1, 2, 3)},
}
"""Limits by joint; those of the right side are mirror images."""


def ball_of(family: str | None, name: str) -> BallJoint | None:
    """Returns a joint of a human body with its limits; None if they are unknown.

    Args:
        family: The family of the model.
        name: Name of the joint.
    """
    side, _, part = name.rpartition("_")
    if family not in HUMAN or part not in _RANGES:
        return None
    one = _RANGES[part]
    mirrored = side == "right"
    return BallJoint(
        type="ball",
        twist_axis=_sided(one.twist_axis, mirrored),
        swing_axis=_sided(one.swing_axis, mirrored),
        centre_deg=_sided(one.centre, mirrored),
        swing_deg=one.swing,
        twist_deg=(-one.twist, one.twist),
    )


def stances_of(family: str | None) -> dict[str, PoseDescription]:
    """Returns the likely poses of a human body in the first frame; none of other models.

    Args:
        family: The family of the model.
    """
    if family not in HUMAN:
        return {}
    assert family is not None
    known = FAMILIES[family]
    return {
        stance: PoseDescription(
            joints={joint: angles for joint, angles in joints.items() if joint in known}
        )
        for stance, joints in _STANCES.items()
    }


def _sided(axial: Vector, mirrored: bool) -> Vector:
    """Returns a rotation vector, or its mirror image in the plane x = 0."""
    x, y, z = axial
    return (x, -y + 0.0, -z + 0.0) if mirrored else axial


def _both(**left: Vector) -> dict[str, Vector]:
    """Returns the rotation vectors of joints on both sides, from those on the left."""
    return {
        f"{side}_{joint}": _sided(angles, side == "right")
        for joint, angles in left.items()
        for side in ("left", "right")
    }


_STRIDE: dict[str, Vector] = {
    "left_hip": (-25, 0, 0),
    "right_hip": (15, 0, 0),
    "right_knee": (30, 0, 0),
    "left_shoulder": _from_hanging(15, 0, 8),
    "right_shoulder": _sided(_from_hanging(-20, 0, 8), mirrored=True),
    **_both(elbow=(0, -20, 0)),
}

_STANCES: dict[str, dict[str, Vector]] = {
    "relaxed": _both(shoulder=_from_hanging(0, 0, 10), elbow=(0, -15, 0)),
    "a_pose": _both(shoulder=_from_hanging(0, 0, 40)),
    "arms_forward": _both(shoulder=_from_hanging(-30, 0, 0), elbow=(0, -70, 0)),
    "left_stride": _STRIDE,
    "right_stride": {
        ("right" if joint.startswith("left") else "left") + "_" + joint.partition("_")[2]: _sided(
            angles, mirrored=True
        )
        for joint, angles in _STRIDE.items()
    },
    "sitting": _both(
        hip=(-85, 0, 0),
        knee=(85, 0, 0),
        shoulder=_from_hanging(0, 0, 5),
        elbow=(0, -30, 0),
    ),
}
"""Rotation vectors of joints, in degrees; the T-pose is the rest pose, which is always tried."""
