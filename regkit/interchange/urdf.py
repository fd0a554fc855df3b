"""Robots as URDF: links, and the joints between them.

Source: ROS, Unified Robot Description Format, http://wiki.ros.org/urdf/XML. Lengths are in metres
and angles in radians. ``spherical`` is no joint of that description; Bullet has it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from regkit.arrays import Array
from regkit.errors import DataError
from regkit.interchange.xml_lines import Element
from regkit.model import did_you_mean
from regkit.rigid import rigid
from regkit.rotation import vector_to_matrix

HINGES = ("revolute", "continuous")
"""The types of joints that turn about an axis."""

TYPES = (*HINGES, "fixed", "spherical")
"""The types of joints that are read."""


@dataclass(frozen=True)
class UrdfLink:
    """A rigid part.

    Attributes:
        name: Its name.
        shapes: ``collision`` elements, or where there are none, ``visual`` ones.
    """

    name: str
    shapes: tuple[Element, ...]


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


@dataclass(frozen=True)
class Urdf:
    """A robot.

    Attributes:
        name: Its name.
        links: Its links by name, parents first.
        joints: Its joints by the name of the link that they move; the root has none.
    """

    name: str
    links: Mapping[str, UrdfLink]
    joints: Mapping[str, UrdfJoint]

    @classmethod
    def read(cls, path: Path) -> Urdf:
        """Read a file.

        Raises:
            DataError: If the file is missing or wrong, or a joint is of another type; it says in
                which line.
        """
        robot = Element.read(path)
        if robot.tag != "robot":
            raise robot.wrong(f"<{robot.tag}> where <robot> should stand; this is no URDF")
        links: dict[str, UrdfLink] = {}
        for element in robot.all("link"):
            name = element.text("name")
            if name in links:
                raise element.wrong(f"a second link is called '{name}'")
            shapes = tuple(element.all("collision")) or tuple(element.all("visual"))
            links[name] = UrdfLink(name, shapes)
        joints: dict[str, UrdfJoint] = {}
        for element in robot.all("joint"):
            joint = _joint(element)
            for link in (joint.parent, joint.child):
                if link not in links:
                    raise element.wrong(
                        f"joint '{joint.name}': there is no link '{link}'"
                        + did_you_mean(link, list(links))
                    )
            if joint.child in joints:
                raise element.wrong(f"a second joint moves the link '{joint.child}'")
            joints[joint.child] = joint
        roots = [name for name in links if name not in joints]
        if len(roots) != 1:
            named = f" ({', '.join(roots)})" if roots else ""
            raise robot.wrong(f"{len(roots)} links have no joint above them{named}; one must")
        for name in roots:
            roots += [child for child, joint in joints.items() if joint.parent == name]
        if len(roots) < len(links):
            cyclic = ", ".join(name for name in links if name not in roots)
            raise robot.wrong(f"the links {cyclic} form a cycle")
        named = robot.attributes.get("name", path.stem)
        return cls(named, {name: links[name] for name in roots}, _resolved(joints))


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


def _joint(element: Element) -> UrdfJoint:
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
    return Mimic(
        element.text("joint"), element.number("multiplier", 1.0), element.number("offset", 0.0)
    )


def _resolved(joints: Mapping[str, UrdfJoint]) -> dict[str, UrdfJoint]:
    """The joints with every mimic following one that follows none.

    Raises:
        DataError: If one follows a joint that there is not, or itself.
    """
    by_name = {joint.name: joint for joint in joints.values()}
    resolved = dict(joints)
    for child, joint in joints.items():
        mimic, seen = joint.mimic, [joint.name]
        while mimic is not None:
            leader = by_name.get(mimic.joint)
            if leader is None or leader.name in seen:
                raise DataError(
                    f"joint '{joint.name}' follows '{mimic.joint}', "
                    + ("which follows it" if leader else "which is no joint")
                    + did_you_mean(mimic.joint, [] if leader else list(by_name)),
                    place=joint.place,
                )
            seen.append(leader.name)
            resolved[child] = replace(joint, mimic=mimic)
            if leader.mimic is None:
                break
            # a = r b + o and b = s c + p give a = r s c + (r p + o).
            above = leader.mimic
            offset = mimic.ratio * above.offset + mimic.offset
            mimic = Mimic(above.joint, mimic.ratio * above.ratio, offset)
    return resolved
