"""Robots as URDF: links, and the joints between them.

Source: ROS, Unified Robot Description Format, http://wiki.ros.org/urdf/XML. Lengths are in metres
and angles in radians. ``spherical`` is no joint of that description; Bullet has it.
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
    """A rigid part.

    Attributes:
        name: Its name.
        shapes: ``collision`` elements, or where there are none, ``visual`` ones.
    """

    name: str
    shapes: tuple[Element, ...]


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
            joint = read_joint(element)
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
        return cls(named, {name: links[name] for name in roots}, resolved(joints))
