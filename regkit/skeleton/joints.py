"""The YAML description of joints: type, axes, and limits in degrees, or metres of a slide."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import AfterValidator, BeforeValidator, Field, model_validator

from regkit.config.model import Model
from regkit.config.quantities import Angle, Coordinate, Turn

Vector = tuple[float, float, float]

Position = tuple[Coordinate, Coordinate, Coordinate]
"""A position in a segment's frame [m]."""

Rotation = tuple[Turn, Turn, Turn]
"""A rotation vector [deg]."""

Letter = Literal["x", "y", "z", "-x", "-y", "-z"]
"""A signed coordinate axis."""

_LETTERS: dict[str, Vector] = {
    "x": (1.0, 0.0, 0.0),
    "y": (0.0, 1.0, 0.0),
    "z": (0.0, 0.0, 1.0),
    "-x": (-1.0, 0.0, 0.0),
    "-y": (0.0, -1.0, 0.0),
    "-z": (0.0, 0.0, -1.0),
}


MAX_RATIO = 1e3
"""Largest magnitude of a coupling's ratio; above it the leader is practically fixed."""

MIN_RATIO = 1e-3
"""Smallest magnitude of a coupling's ratio; below it the joint is practically fixed."""


def _from_letter(value: Any) -> Any:
    if isinstance(value, str) and value in _LETTERS:
        return _LETTERS[value]
    if isinstance(value, str):
        raise ValueError(f"{value!r} is not an axis: write x, y, z, -x, -y, -z or three numbers")
    return value


def _of_unit_length(value: Vector) -> Vector:
    length = float(np.linalg.norm(value))
    if not 1e-9 <= length <= 1e9:
        raise ValueError(
            f"the axis {list(value)} has no direction; its length must not be zero, nor above 1e9"
        )
    x, y, z = value
    return (x / length, y / length, z / length)


def in_order(value: tuple[float, float]) -> tuple[float, float]:
    """Returns a lower and an upper limit, which must be in this order."""
    if value[0] > value[1]:
        raise ValueError(f"limits are reversed: {list(value)}; write [{value[1]}, {value[0]}]")
    return value


def _not_zero(value: float) -> float:
    if abs(value) < MIN_RATIO:
        raise ValueError(
            f"the ratio {value:g} is too small: its magnitude must be at least {MIN_RATIO:g}; for "
            "a joint that does not move write type: fixed"
        )
    if abs(value) > MAX_RATIO:
        raise ValueError(
            f"the ratio {value:g} is too large: its magnitude must be at most {MAX_RATIO:g}"
        )
    return value


Axis = Annotated[
    Vector,
    BeforeValidator(_from_letter, json_schema_input_type=Letter | Vector),
    AfterValidator(_of_unit_length),
]
"""A direction: three numbers of any length, or one of x, y, z, -x, -y, -z."""

Range = Annotated[tuple[Angle, Angle], AfterValidator(in_order)]
"""A lower and an upper limit of an angle [deg]."""

Travel = Annotated[tuple[Coordinate, Coordinate], AfterValidator(in_order)]
"""A lower and an upper limit of a displacement [m]."""


def _within_half_a_turn(value: tuple[float, float]) -> tuple[float, float]:
    if value[0] < -180.0 or value[1] > 180.0:
        raise ValueError(
            f"twist limits must be between -180 and 180 degrees; they are {list(value)}; rotate "
            "the centre of the cone (centre_deg) instead"
        )
    return value


TwistRange = Annotated[Range, AfterValidator(_within_half_a_turn)]

HalfAngle = Annotated[float, Field(ge=0.01, le=180.0)]


class FreeJoint(Model):
    """The segment translates and rotates freely: six degrees of freedom.

    The root moves in the world, another segment in its parent's frame. Several free segments on a
    fixed root are several bodies in one scene.
    """

    type: Literal["free"] = "free"


class FixedJoint(Model):
    """The segment is rigidly attached to its parent."""

    type: Literal["fixed"] = "fixed"


class CouplingDescription(Model):
    """Couples a hinge to another hinge: ``angle = ratio * leader + offset_deg``."""

    to: str
    """Segment whose hinge is the leader."""
    ratio: Annotated[float, AfterValidator(_not_zero)]
    """Change of this angle per change of the leader's angle."""
    offset_deg: Angle = 0.0
    """Angle at which the leader's angle is zero [deg]."""


class HingeJoint(Model):
    """A revolute joint: one angle about one axis."""

    type: Literal["hinge"]
    axis: Axis
    """Rotation axis in the segment's frame."""
    limits_deg: Range | None = None
    """Smallest and largest angle [deg]; unlimited by default."""
    coupled: CouplingDescription | None = None
    """Coupling to another hinge; by default the hinge is independent."""


class PrismaticCouplingDescription(Model):
    """Couples a prismatic joint to another: ``displacement = ratio * leader + offset``."""

    to: str
    """Segment whose prismatic joint is the leader."""
    ratio: Annotated[float, AfterValidator(_not_zero)]
    """Change of this displacement per change of the leader's."""
    offset: Coordinate = 0.0
    """Displacement at which the leader's is zero [m]."""


class PrismaticJoint(Model):
    """A sliding joint: one displacement along one axis."""

    type: Literal["prismatic"]
    axis: Axis
    """Direction of the displacement in the segment's frame."""
    limits: Travel
    """Smallest and largest displacement [m]."""
    coupled: PrismaticCouplingDescription | None = None
    """Coupling to another prismatic joint, as of a gripper's second finger; by default the joint is
    independent."""


class UniversalJoint(Model):
    """Two hinges in series; the second axis rotates with the first hinge."""

    type: Literal["universal"]
    axes: tuple[Axis, Axis]
    """Axes of the first and the second hinge, each in its own frame."""
    limits_deg: tuple[Range, Range] | None = None
    """Smallest and largest angle of each hinge [deg]; unlimited by default."""


class BallJoint(Model):
    """A spherical joint with swing-twist limits.

    The rotation relative to the centre is decomposed as ``swing * twist``. The swing, a rotation
    vector perpendicular to the twist axis, is limited to an ellipse, so the bone to an elliptic
    cone; the twist about the bone is limited to an interval.
    """

    type: Literal["ball"]
    twist_axis: Axis = (0.0, 1.0, 0.0)
    """The bone's direction in the segment's frame."""
    swing_axis: Axis = (1.0, 0.0, 0.0)
    """Axis of the first swing angle, perpendicular to the twist axis; the second is their cross
    product."""
    centre_deg: Rotation = (0.0, 0.0, 0.0)
    """Rotation vector of the cone's centre relative to the rest pose [deg]."""
    swing_deg: tuple[HalfAngle, HalfAngle] | None = None
    """Half angles of the cone about the first and the second swing axis [deg]; unlimited by
    default."""
    twist_deg: TwistRange | None = None
    """Smallest and largest twist [deg]; unlimited by default."""

    @model_validator(mode="after")
    def _axes_at_right_angles(self) -> BallJoint:
        if abs(float(np.dot(self.twist_axis, self.swing_axis))) > 1e-6:
            raise ValueError(
                f"twist_axis {list(self.twist_axis)} and swing_axis {list(self.swing_axis)} must "
                "be perpendicular"
            )
        return self


Joint = Annotated[
    FreeJoint | FixedJoint | HingeJoint | PrismaticJoint | UniversalJoint | BallJoint,
    Field(discriminator="type"),
]
