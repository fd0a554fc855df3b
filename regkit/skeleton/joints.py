"""What a skeleton's YAML says of a joint: its type, axes and limits, in degrees."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import AfterValidator, BeforeValidator, Field, model_validator

from regkit.config.model import Model

Vector = tuple[float, float, float]

Letter = Literal["x", "y", "z", "-x", "-y", "-z"]
"""A direction along an axis."""

_LETTERS: dict[str, Vector] = {
    "x": (1.0, 0.0, 0.0),
    "y": (0.0, 1.0, 0.0),
    "z": (0.0, 0.0, 1.0),
    "-x": (-1.0, 0.0, 0.0),
    "-y": (0.0, -1.0, 0.0),
    "-z": (0.0, 0.0, -1.0),
}


LEAST_RATIO = 1e-3
"""A hinge that turns by less than this with its leader can as well be fixed."""


def _from_letter(value: Any) -> Any:
    if isinstance(value, str) and value in _LETTERS:
        return _LETTERS[value]
    if isinstance(value, str):
        raise ValueError(f"an axis is x, y, z, -x, -y, -z or three numbers; it is {value!r}")
    return value


def _of_unit_length(value: Vector) -> Vector:
    length = float(np.linalg.norm(value))
    if length < 1e-9:
        raise ValueError("an axis must not be zero")
    x, y, z = value
    return (x / length, y / length, z / length)


def _in_order(value: tuple[float, float]) -> tuple[float, float]:
    if value[0] > value[1]:
        raise ValueError(f"limits are reversed: {list(value)}; write [{value[1]}, {value[0]}]")
    return value


def _not_zero(value: float) -> float:
    if abs(value) < LEAST_RATIO:
        raise ValueError(
            f"a ratio is at least {LEAST_RATIO:g}, or at most -{LEAST_RATIO:g}; it is {value:g}; a "
            "joint that does not turn is of type fixed"
        )
    return value


Axis = Annotated[
    Vector,
    BeforeValidator(_from_letter, json_schema_input_type=Letter | Vector),
    AfterValidator(_of_unit_length),
]
"""A direction: three numbers of any length, or one of x, y, z, -x, -y, -z."""

Range = Annotated[tuple[float, float], AfterValidator(_in_order)]
"""A lower and an upper limit."""


def _within_half_a_turn(value: tuple[float, float]) -> tuple[float, float]:
    if value[0] < -180.0 or value[1] > 180.0:
        raise ValueError(
            f"a twist is between -180 and 180 degrees; the limits are {list(value)}; turn the "
            "middle of the cone (centre_deg) instead"
        )
    return value


TwistRange = Annotated[Range, AfterValidator(_within_half_a_turn)]

HalfAngle = Annotated[float, Field(gt=0.0, le=180.0)]


class FreeJoint(Model):
    """The root moves and turns freely in the world: six degrees of freedom."""

    type: Literal["free"] = "free"


class FixedJoint(Model):
    """The segment moves with its parent."""

    type: Literal["fixed"] = "fixed"


class CouplingDescription(Model):
    """A hinge's angle follows that of another: ``ratio * angle + offset_deg``."""

    to: str
    """The segment whose hinge leads."""
    ratio: Annotated[float, AfterValidator(_not_zero)]
    """By how much the angle turns with that of the leader."""
    offset_deg: float = 0.0
    """The angle where that of the leader is zero [deg]."""


class HingeJoint(Model):
    """One angle about an axis."""

    type: Literal["hinge"]
    axis: Axis
    """Axis of the rotation in the segment's frame."""
    limits_deg: Range | None = None
    """Smallest and largest angle [deg]; without them the hinge turns freely."""
    coupled: CouplingDescription | None = None
    """What the angle follows from, if it is not free."""


class UniversalJoint(Model):
    """Two hinges, one after the other: the second axis turns with the first."""

    type: Literal["universal"]
    axes: tuple[Axis, Axis]
    """Axes of the two rotations in the frames in which they act."""
    limits_deg: tuple[Range, Range] | None = None
    """Smallest and largest angle of each [deg]."""


class BallJoint(Model):
    """Any rotation, split for its limits into a swing of the bone and a twist about it.

    The rotation relative to the centre is ``swing * twist``. The swing, a rotation vector at right
    angles to the twist axis, must lie in an ellipse (an elliptic cone for the bone).
    """

    type: Literal["ball"]
    twist_axis: Axis = (0.0, 1.0, 0.0)
    """The bone's direction in the segment's frame."""
    swing_axis: Axis = (1.0, 0.0, 0.0)
    """Axis of the first swing angle; that of the second is at right angles to both."""
    centre_deg: Vector = (0.0, 0.0, 0.0)
    """Rotation vector of the middle of the cone, relative to the rest pose [deg]."""
    swing_deg: tuple[HalfAngle, HalfAngle] | None = None
    """The cone's half angles about the first and the second swing axis [deg]."""
    twist_deg: TwistRange | None = None
    """Smallest and largest twist [deg]."""

    @model_validator(mode="after")
    def _axes_at_right_angles(self) -> BallJoint:
        if abs(float(np.dot(self.twist_axis, self.swing_axis))) > 1e-6:
            raise ValueError("twist_axis and swing_axis must be at right angles")
        return self


Joint = Annotated[
    FreeJoint | FixedJoint | HingeJoint | UniversalJoint | BallJoint, Field(discriminator="type")
]
