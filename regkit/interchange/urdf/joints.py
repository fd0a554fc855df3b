"""The joints of a URDF."""

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
"""The types of joints that turn about an axis."""

TYPES = (*HINGES, "fixed", "spherical")
"""The types of joints that are read."""


@dataclass(frozen=True)
class Mimic:
    """A joint's angle is ``ratio`` times that of another, plus an offset.

    Attributes:
        joint: Name of the joint that leads.
        ratio: By how much it turns with that.
        offset: Where that is zero [rad].
    """

    joint: str
    ratio: float
    offset: float


@dataclass(frozen=True)
class UrdfJoint:
    """What ties a link to its parent.

    Attributes:
        name: Its name.
        kind: One of ``TYPES``.
        parent: Name of the link above.
        child: Name of the link that it moves; their frames are one.
        origin: T_parent_child at zero angles, (4, 4) [m].
        axis: (3,) unit axis in the child's frame.
        limits: Smallest and largest angle [rad], of a revolute joint.
        mimic: What its angle follows, if it does.
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
    """The transform (4, 4) of an element's ``origin``, or the identity [m]."""
    found = element.find("origin")
    if found is None:
        return np.eye(4)
    # Roll, pitch and yaw turn about fixed axes, one after the other.
    angles = found.numbers("rpy", 3, np.zeros(3))
    x, y, z = (
        vector_to_matrix(angle * axis) for angle, axis in zip(angles, np.eye(3), strict=True)
    )
    return rigid(z @ y @ x, found.numbers("xyz", 3, np.zeros(3)))


def read_joint(element: Element) -> UrdfJoint:
    """The joint in an element.

    Raises:
        DataError: If something is missing or wrong, or it is of another type; it says in which
            line.
    """
    name, kind = element.text("name"), element.text("type")
    if kind not in TYPES:
        raise element.wrong(
            f"joint '{name}' is {kind}; a template's joints only turn ({', '.join(TYPES)})"
        )
    parent, child = element.need("parent").text("link"), element.need("child").text("link")
    axis = np.array([1.0, 0.0, 0.0])
    if (found := element.find("axis")) is not None:
        axis = found.numbers("xyz", 3)
        if np.linalg.norm(axis) < 1e-9:
            raise found.wrong(f"the axis of joint '{name}' is zero")
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
        raise element.wrong(f"lower={low:g} is above upper={high:g}")
    return low, high


def _mimic(element: Element) -> Mimic:
    ratio = element.number("multiplier", 1.0)
    if abs(ratio) < MIN_RATIO:
        raise element.wrong(f"multiplier={ratio:g}: a joint that does not turn must be fixed")
    return Mimic(element.text("joint"), ratio, element.number("offset", 0.0))


def resolved(joints: Mapping[str, UrdfJoint]) -> dict[str, UrdfJoint]:
    """The joints with every mimic following one that follows none.

    Raises:
        DataError: If one follows no hinge, or itself.
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
                raise DataError(f"joint '{joint.name}' follows itself", place=joint.place)
            seen.append(mimic.joint)
            # a = r b + o and b = s c + p give a = r s c + (r p + o).
            offset = mimic.ratio * above.offset + mimic.offset
            mimic = Mimic(above.joint, mimic.ratio * above.ratio, offset)
        led[child] = replace(joint, mimic=mimic)
    return led


def _check_leader(joint: UrdfJoint, name: str, joints: Mapping[str, UrdfJoint]) -> None:
    leader = joints.get(name)
    kind = "which is no joint" if leader is None else f"which is {leader.kind}"
    if leader is None or leader.kind not in HINGES:
        raise DataError(
            f"joint '{joint.name}' follows '{name}', {kind}; it can follow a hinge "
            f"({' or '.join(HINGES)})" + ("" if leader else did_you_mean(name, list(joints))),
            place=joint.place,
        )
