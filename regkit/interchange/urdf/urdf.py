"""URDF robots: links, and the joints between them.

Source: ROS, Unified Robot Description Format, http://wiki.ros.org/urdf/XML. Lengths are in metres
and angles in radians. The joint type ``spherical`` is an extension of Bullet.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from regkit.config.model import did_you_mean
from regkit.interchange.urdf.joints import UrdfJoint, read_joint, resolved
from regkit.interchange.urdf.xml_lines import Element


@dataclass(frozen=True)
class UrdfLink:
    """A link.

    Attributes:
        name: Name of the link.
        shapes: Its ``collision`` elements, or if there are none, its ``visual`` elements.
    """

    name: str
    shapes: tuple[Element, ...]


@dataclass(frozen=True)
class Urdf:
    """A robot.

    Attributes:
        name: Name of the robot.
        links: Links by name, parents before children.
        joints: Joints by the name of their child link; the root has none.
    """

    name: str
    links: Mapping[str, UrdfLink]
    joints: Mapping[str, UrdfJoint]

    @classmethod
    def read(cls, path: Path) -> Urdf:
        """Reads a URDF file.

        Raises:
            DataError: If the file is missing or invalid, or has an unsupported joint type.
        """
        robot = Element.read(path)
        if robot.tag != "robot":
            raise robot.wrong(f"<{robot.tag}> where <robot> is expected; this is not a URDF file")
        links: dict[str, UrdfLink] = {}
        for element in robot.all("link"):
            name = element.text("name")
            if name in links:
                raise element.wrong(f"a second link is named '{name}'; names must be unique")
            shapes = tuple(element.all("collision")) or tuple(element.all("visual"))
            links[name] = UrdfLink(name, shapes)
        joints: dict[str, UrdfJoint] = {}
        for element in robot.all("joint"):
            joint = read_joint(element)
            for link in (joint.parent, joint.child):
                if link not in links:
                    raise element.wrong(
                        f"joint '{joint.name}': there is no link '{link}'"
                        + did_you_mean(link, list(links))
                    )
            if joint.child in joints:
                raise element.wrong(
                    f"a second joint has the child link '{joint.child}'; a link has one parent"
                )
            joints[joint.child] = joint
        roots = [name for name in links if name not in joints]
        if len(roots) != 1:
            named = f" ({', '.join(roots)})" if roots else ""
            raise robot.wrong(
                f"{len(roots)} links have no parent joint{named}; there must be exactly one root"
            )
        for name in roots:
            roots += [child for child, joint in joints.items() if joint.parent == name]
        if len(roots) < len(links):
            cyclic = ", ".join(name for name in links if name not in roots)
            raise robot.wrong(f"the links {cyclic} form a cycle; they must form a tree")
        named = robot.attributes.get("name", path.stem)
        return cls(named, {name: links[name] for name in roots}, resolved(joints))
