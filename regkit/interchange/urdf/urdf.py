"""URDF robots: links, and the joints between them.

Source: ROS, Unified Robot Description Format, http://wiki.ros.org/urdf/XML. Lengths are in metres
and angles in radians. The joint type ``spherical`` is an extension of Bullet.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from regkit.config.model import did_you_mean
from regkit.interchange.remarks import Remarks
from regkit.interchange.urdf.joints import UrdfJoint, read_joint
from regkit.interchange.urdf.leaders import with_leaders
from regkit.interchange.urdf.tree import links_in_order, without_worlds
from regkit.interchange.urdf.xml_lines import XACRO, Element
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.guard import reading


@dataclass(frozen=True)
class UrdfLink:
    """A link.

    Attributes:
        name: Name of the link.
        collision: Its ``collision`` elements.
        visual: Its ``visual`` elements.
        empty: Whether it is a frame only, without shapes and inertia.
    """

    name: str
    collision: tuple[Element, ...]
    visual: tuple[Element, ...]
    empty: bool


@dataclass(frozen=True)
class Urdf:
    """A robot.

    Attributes:
        name: Name of the robot.
        links: Links by name, parents before children.
        joints: Joints by the name of their child link; the root has none.
        axes: ``R_file_root``, (3, 3): the root's rotation against the frame in which the robot is
            upright.
    """

    name: str
    links: Mapping[str, UrdfLink]
    joints: Mapping[str, UrdfJoint]
    axes: Array

    @classmethod
    def read(cls, path: Path) -> Urdf:
        """Reads a URDF file.

        Frames above the robot, such as ``world``, are left out. What else is passed over is told.

        Raises:
            DataError: If the file is missing or invalid, or a joint translates.
        """
        with reading(path, "a URDF file"):
            return cls._of(Element.read(path), path)

    @classmethod
    def _of(cls, robot: Element, path: Path) -> Urdf:
        if robot.tag != "robot":
            raise robot.wrong(f"<{robot.tag}> where <robot> is expected; this is not a URDF file")
        macro = next((one for one in robot.everything() if one.tag.startswith("xacro:")), None)
        if macro is not None:
            raise macro.wrong(f"<{macro.tag}> is an instruction of xacro; {XACRO}")
        remarks = Remarks()
        links, joints = _links(robot), _joints(robot, remarks)
        _check_links(links, joints, remarks)
        order = links_in_order(list(links), joints, robot, remarks)
        order, axes = without_worlds([links[name] for name in order], joints, remarks)
        joints = {name: joints[name] for name in order[1:]}
        named = robot.attributes.get("name", "").strip() or path.stem
        ordered = {name: links[name] for name in order}
        found = cls(named, ordered, with_leaders(joints, remarks), axes)
        remarks.tell()
        return found


def _links(robot: Element) -> dict[str, UrdfLink]:
    links: dict[str, UrdfLink] = {}
    for element in robot.all("link"):
        name = element.text("name")
        if not name.strip():
            raise element.wrong("the name of a link is empty; it must have one")
        if name in links:
            raise element.wrong(f"a second link is named '{name}'; names must be unique")
        collision, visual = (tuple(element.all(tag)) for tag in ("collision", "visual"))
        empty = not collision and not visual and element.find("inertial") is None
        links[name] = UrdfLink(name, collision, visual, empty)
    return links


def _joints(robot: Element, remarks: Remarks) -> dict[str, UrdfJoint]:
    """Returns the joints by their child links."""
    joints: dict[str, UrdfJoint] = {}
    for element in robot.all("joint"):
        joint = read_joint(element, remarks)
        if joint.child in joints:
            raise element.wrong(
                f"a second joint has the child link '{joint.child}'; a link has one parent"
            )
        joints[joint.child] = joint
    return joints


def _check_links(
    links: dict[str, UrdfLink], joints: Mapping[str, UrdfJoint], remarks: Remarks
) -> None:
    """Checks that joints connect links, and adds a root that only joints name.

    Raises:
        DataError: If there is no such link.
    """
    parents = {joint.parent for joint in joints.values()} - links.keys()
    if len(parents) == 1 and links.keys() <= joints.keys():
        # A misspelt name would leave a second link without a parent.
        (root,) = parents
        links[root] = UrdfLink(root, (), (), empty=True)
        place = next(joint.place for joint in joints.values() if joint.parent == root)
        remarks.add("the root is not among the links, and taken as empty", root, place)
    for joint in joints.values():
        for link in (joint.parent, joint.child):
            if link not in links:
                raise DataError(
                    f"joint '{joint.name}': there is no link '{link}'"
                    + did_you_mean(link, list(links)),
                    place=joint.place,
                )
