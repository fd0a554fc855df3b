"""The joints of a URDF file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from regkit.config.model import did_you_mean
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.interchange.urdf.xml_lines import Element
from regkit.skeleton.joints import MIN_RATIO
from regkit.system.arrays import Array
from regkit.system.errors import DataError

HINGES = ("revolute", "continuous")
"""Joint types with one rotation axis."""

TYPES = (*HINGES, "fixed", "spherical")
"""Supported joint types."""


@dataclass(frozen=True)
class Mimic:
    """A coupling ``angle = ratio * leader + offset``.

    Attributes:
        joint: Name of the leading joint.
        ratio: Ratio of the angles.
        offset: Angle at which the leader's angle is zero [rad].
    """

    joint: str
    ratio: float
    offset: float


@dataclass(frozen=True)
class UrdfJoint:
    """The joint between a link and its parent.

    Attributes:
        name: Name of the joint.
        kind: One of ``TYPES``.
        parent: Name of the parent link.
        child: Name of the child link, which has the frame of the joint.
        origin: T_parent_child at zero angles, (4, 4) [m].
        axis: Unit axis in the child's frame, (3,).
        limits: Smallest and largest angle of a revolute joint [rad]; None for others.
        mimic: Coupling to another joint, if there is one.
        place: ``file:line``.
    """

    name: str
    kind: str
    parent: str
    child: str
    origin: Array
    axis: Array
    limits: tuple[float, float] | None
    mimic: Mimic | None
    place: str


def origin(element: Element) -> Array:
    """Returns the transform (4, 4) [m] of an element's ``origin``; the identity without one.

    Raises:
        DataError: If its attributes are invalid.
    """
    found = element.find("origin")
    if found is None:
        return np.eye(4)
    # Roll, pitch and yaw are rotations about fixed axes, in this order.
    angles = found.numbers("rpy", 3, np.zeros(3))
    x, y, z = (
        vector_to_matrix(angle * axis) for angle, axis in zip(angles, np.eye(3), strict=True)
    )
    return rigid(z @ y @ x, found.numbers("xyz", 3, np.zeros(3)))


def read_joint(element: Element) -> UrdfJoint:
    """Returns the joint of an element.

    Raises:
        DataError: If an attribute is missing or invalid, or the type is not supported.
    """
    name, kind = element.text("name"), element.text("type")
    if kind not in TYPES:
        raise element.wrong(
            f"joint '{name}' is {kind}; the joints of a template can only be {', '.join(TYPES)}"
        )
    parent, child = element.need("parent").text("link"), element.need("child").text("link")
    axis = np.array([1.0, 0.0, 0.0])
    if (found := element.find("axis")) is not None:
        axis = found.numbers("xyz", 3)
        if np.linalg.norm(axis) < 1e-9:
            raise found.wrong(f"the axis of joint '{name}' is zero; it must have a direction")
    limits = _limits(element.need("limit")) if kind == "revolute" else None
    mimic = element.find("mimic")
    return UrdfJoint(
        name=name,
        kind=kind,
        parent=parent,
        child=child,
        origin=origin(element),
        axis=axis / np.linalg.norm(axis),
        limits=limits,
        mimic=None if mimic is None else _mimic(mimic),
        place=element.place,
    )


def _limits(element: Element) -> tuple[float, float]:
    low, high = element.number("lower", 0.0), element.number("upper", 0.0)
    if low > high:
        raise element.wrong(f"lower={low:g} is above upper={high:g}; exchange them")
    return low, high


def _mimic(element: Element) -> Mimic:
    ratio = element.number("multiplier", 1.0)
    if abs(ratio) < MIN_RATIO:
        raise element.wrong(
            f"multiplier={ratio:g} is too small; make a joint that does not turn a fixed joint"
        )
    return Mimic(element.text("joint"), ratio, element.number("offset", 0.0))


def resolved(joints: Mapping[str, UrdfJoint]) -> dict[str, UrdfJoint]:
    """Returns the joints with chains of couplings resolved to independent leaders.

    Args:
        joints: Joints by the name of their child link.

    Raises:
        DataError: If a joint follows itself, or a joint that is not a hinge.
    """
    by_name = {joint.name: joint for joint in joints.values()}
    for joint in joints.values():
        if joint.mimic is not None:
            _check_leader(joint, joint.mimic.joint, by_name)
    led = dict(joints)
    for child, joint in joints.items():
        mimic, seen = joint.mimic, [joint.name]
        while mimic is not None and (above := by_name[mimic.joint].mimic) is not None:
            if mimic.joint in seen:
                raise DataError(
                    f"joint '{joint.name}' follows itself ({' -> '.join([*seen, mimic.joint])})",
                    place=joint.place,
                )
            seen.append(mimic.joint)
            # a = r b + o and b = s c + p give a = r s c + (r p + o).
            offset = mimic.ratio * above.offset + mimic.offset
            mimic = Mimic(above.joint, mimic.ratio * above.ratio, offset)
        led[child] = replace(joint, mimic=mimic)
    return led


def _check_leader(joint: UrdfJoint, name: str, joints: Mapping[str, UrdfJoint]) -> None:
    leader = joints.get(name)
    kind = "which is not a joint" if leader is None else f"which is {leader.kind}"
    if leader is None or leader.kind not in HINGES:
        raise DataError(
            f"joint '{joint.name}' follows '{name}', {kind}; it can follow a hinge "
            f"({' or '.join(HINGES)})" + ("" if leader else did_you_mean(name, list(joints))),
            place=joint.place,
        )
