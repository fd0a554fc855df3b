"""The tree of a URDF file: its root, and which of its joints a template can have."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

import numpy as np

from regkit.interchange.remarks import Remarks
from regkit.interchange.urdf.joints import OTHERS, UrdfJoint
from regkit.interchange.urdf.xml_lines import Element
from regkit.system.arrays import Array
from regkit.system.errors import DataError

LISTED = 20
"""Number of names that a message lists."""


class Frame(Protocol):
    """A link, as far as the tree is concerned."""

    @property
    def name(self) -> str:
        """Name of the link."""

    @property
    def empty(self) -> bool:
        """Whether it is a frame only, without shapes and inertia."""


def links_in_order(
    names: Sequence[str], joints: Mapping[str, UrdfJoint], robot: Element, remarks: Remarks
) -> list[str]:
    """Returns the names of the links, parents before children.

    Links that no joint connects to the robot are left out.

    Args:
        names: Names of all links.
        joints: Joints by the name of their child link.
        robot: The root element, for the place of errors.
        remarks: Takes what is left out.

    Raises:
        DataError: If there is not exactly one root, or links form a cycle.
    """
    children: dict[str, list[str]] = {name: [] for name in names}
    for child, joint in joints.items():
        children[joint.parent].append(child)
    roots = [name for name in names if name not in joints]
    if len(roots) > 1 and any(children[name] for name in roots):
        for name in roots:
            if not children[name]:
                remarks.add("links that no joint connects are left out", name, robot.place)
        roots = [name for name in roots if children[name]]
    if not names:
        raise robot.wrong("the robot has no <link>; it needs at least one")
    if len(roots) != 1:
        named = f" ({', '.join(roots[:LISTED])})" if roots else ""
        raise robot.wrong(
            f"{len(roots)} links have no parent joint{named}; there must be exactly one root"
        )
    ordered = list(roots)
    for name in ordered:
        ordered += children[name]
    cyclic = [name for name in joints if name not in set(ordered)]
    if cyclic:
        raise robot.wrong(
            f"the links {', '.join(cyclic[:LISTED])} form a cycle; they must form a tree"
        )
    return ordered


def without_worlds(
    links: Sequence[Frame], joints: Mapping[str, UrdfJoint], remarks: Remarks
) -> tuple[list[str], Array]:
    """Returns the names of the links from the robot's own root on, and ``R_file_root`` (3, 3).

    Simulators put an empty link such as ``world`` or ``base_footprint`` above the robot, with a
    floating or a fixed joint. A template's root is free in the world, so the link below is the
    root.

    Args:
        links: The links, parents before children.
        joints: Joints by the name of their child link.
        remarks: Takes what is left out.

    Raises:
        DataError: If a joint below the root translates.
    """
    order, axes = list(links), np.eye(3)
    while len(order) > 1:
        below = [joint for joint in joints.values() if joint.parent == order[0].name]
        if not (order[0].empty and len(below) == 1 and below[0].kind in ("fixed", "floating")):
            break
        remarks.add(
            "the root is the link below empty frames, free in the world",
            f"{order[0].name} -> {below[0].child}",
            below[0].place,
        )
        axes = axes @ below[0].origin[:3, :3]
        del order[0]
    names = [link.name for link in order]
    _check_turning([joints[name] for name in names[1:]])
    return names, axes


def _check_turning(joints: Sequence[UrdfJoint]) -> None:
    """Checks that no joint translates.

    Raises:
        DataError: If some do; the message lists them all.
    """
    moving = {
        kind: [joint.name for joint in joints if joint.kind == kind]
        for kind in OTHERS
        if any(joint.kind == kind for joint in joints)
    }
    if not moving:
        return
    listed = "; ".join(
        f"{kind}: {', '.join(names[:LISTED])}" + (" ..." if len(names) > LISTED else "")
        for kind, names in moving.items()
    )
    raise DataError(
        f"joints of this robot move in a plane or freely ({listed}); those of a template rotate, "
        "or slide along one axis; make them fixed, or leave their links out",
        place=next(joint.place for joint in joints if joint.kind in OTHERS),
    )
