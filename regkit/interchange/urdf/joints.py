"""The joints of a URDF file."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.interchange.remarks import Remarks
from regkit.interchange.urdf.limits import limits_of
from regkit.interchange.urdf.xml_lines import Element
from regkit.skeleton.joints import MIN_RATIO
from regkit.system.arrays import Array
from regkit.system.errors import DataError

HINGES = ("revolute", "continuous")
"""Joint types with one rotation axis."""

AXIAL = (*HINGES, "prismatic")
"""Joint types with one axis."""

TYPES = (*AXIAL, "fixed", "spherical")
"""Supported joint types."""

OTHERS = ("floating", "planar")
"""Joint types of the format that translate freely, which a template has only at its root."""


@dataclass(frozen=True)
class Mimic:
    """A coupling ``position = ratio * leader + offset``, of angles or of displacements.

    Attributes:
        joint: Name of the leading joint.
        ratio: Ratio of the positions.
        offset: Position at which the leader's is zero [rad], or in the file's unit of length.
    """

    joint: str
    ratio: float
    offset: float


@dataclass(frozen=True)
class UrdfJoint:
    """The joint between a link and its parent.

    Attributes:
        name: Name of the joint.
        kind: One of ``TYPES`` or ``OTHERS``.
        parent: Name of the parent link.
        child: Name of the child link, which has the frame of the joint.
        origin: T_parent_child at zero angles, (4, 4) [m].
        axis: Unit axis in the child's frame, (3,).
        limits: Smallest and largest angle of a revolute joint [rad], or displacement of a prismatic
            one in the file's unit of length; None for others.
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


def read_joint(element: Element, remarks: Remarks) -> UrdfJoint:
    """Returns the joint of an element; fields that its type does not use are not read.

    Args:
        element: The element.
        remarks: Takes what is passed over.

    Raises:
        DataError: If an attribute is missing or invalid, or the type is not of the format.
    """
    name, kind = element.text("name"), element.text("type")
    if kind not in (*TYPES, *OTHERS):
        raise element.wrong(
            f"joint '{name}' has the type '{kind}'; the types of the format are "
            f"{', '.join((*TYPES, *OTHERS))}"
        )
    axial = kind in AXIAL
    if not axial and not _has_direction(element.find("axis")):
        remarks.add("joints that turn about no axis have a zero one, unused", name, element.place)
    return UrdfJoint(
        name=name,
        kind=kind,
        parent=element.need("parent").text("link"),
        child=element.need("child").text("link"),
        origin=origin(element),
        axis=_axis(element, name) if axial else np.array([1.0, 0.0, 0.0]),
        limits=limits_of(kind, element, name, remarks),
        mimic=_mimic(element, name, remarks) if axial else None,
        place=element.place,
    )


def _has_direction(axis: Element | None) -> bool:
    """Whether an axis, of a type of joint that needs none, is absent or has a direction."""
    if axis is None:
        return True
    try:
        return bool(axis.numbers("xyz", 3, np.ones(3)).any())
    except DataError:
        return False


def _axis(element: Element, name: str) -> Array:
    """Returns the unit axis of a hinge, x by default, (3,).

    Raises:
        DataError: If it has no direction.
    """
    found = element.find("axis")
    if found is None or "xyz" not in found.attributes:
        return np.array([1.0, 0.0, 0.0])
    axis = found.numbers("xyz", 3)
    length = float(np.linalg.norm(axis))
    if length < 1e-9:
        raise found.wrong(f"the axis of joint '{name}' is zero; it must have a direction")
    return np.asarray(axis / length)


def _mimic(element: Element, name: str, remarks: Remarks) -> Mimic | None:
    found = element.find("mimic")
    # Exporters write <mimic joint=""/> for every joint, as they do with other unused fields.
    if found is None or not found.attributes.get("joint", "").strip():
        return None
    mimic = Mimic(found.text("joint"), found.number("multiplier", 1.0), found.number("offset", 0.0))
    if abs(mimic.ratio) < MIN_RATIO:
        remarks.add(
            "joints move by themselves, because the multiplier of their <mimic> is practically "
            "zero",
            f"{name}: {mimic.ratio:g}",
            found.place,
        )
        return None
    return mimic
