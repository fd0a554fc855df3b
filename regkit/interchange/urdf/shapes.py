"""Approximation of the shapes of URDF links by capsules."""

from __future__ import annotations

import numpy as np

from regkit.interchange.imported import vector
from regkit.interchange.urdf.joints import origin
from regkit.interchange.urdf.urdf import UrdfLink
from regkit.interchange.urdf.xml_lines import Element
from regkit.skeleton.description import CapsuleDescription
from regkit.system.arrays import Array


def capsules_of(link: UrdfLink, T_bone_link: Array, scale: float) -> tuple[CapsuleDescription, ...]:
    """Returns a link's shapes as capsules in a bone's frame.

    Spheres and capsules are exact. A cylinder becomes the inscribed capsule of the same length and
    radius; a cylinder that is shorter than wide, and a cube, the sphere of equal volume. A box
    becomes a capsule along its longest side with the box's cross-sectional area. Meshes are
    ignored.

    Args:
        link: The link.
        T_bone_link: Transform from the link's frame to the bone's, (4, 4) [m].
        scale: Metres per unit of the file.

    Raises:
        DataError: If a length is missing or not positive.
    """
    capsules = []
    for shape in link.shapes:
        core = _core(shape.need("geometry"))
        if core is None:
            continue
        half, radius = core
        T_bone_shape = T_bone_link @ origin(shape)
        ends = [
            vector(scale * (T_bone_shape[:3, :3] @ (sign * half) + T_bone_shape[:3, 3]))
            for sign in (-1.0, 1.0)
        ]
        capsules.append(CapsuleDescription(start=ends[0], end=ends[1], radius=scale * radius))
    return tuple(capsules)


def _core(geometry: Element) -> tuple[Array, float] | None:
    """Returns half the axis (3,) and the radius of a geometry's capsule; None for a mesh."""
    along_z = np.array([0.0, 0.0, 0.5])
    if (sphere := geometry.find("sphere")) is not None:
        return np.zeros(3), _length(sphere, "radius")
    if (capsule := geometry.find("capsule")) is not None:
        # The length is the distance between the centres of the end spheres.
        return along_z * _length(capsule, "length"), _length(capsule, "radius")
    if (cylinder := geometry.find("cylinder")) is not None:
        length, radius = _length(cylinder, "length"), _length(cylinder, "radius")
        return _inside(along_z, length, radius, np.pi * radius**2 * length)
    if (box := geometry.find("box")) is not None:
        sides = box.numbers("size", 3)
        if (sides <= 0.0).any():
            raise box.wrong(f"the sides of a box must be positive: {sides.tolist()}")
        longest = int(np.argmax(sides))
        volume = float(np.prod(sides))
        radius = float(np.sqrt(volume / sides[longest] / np.pi))
        return _inside(0.5 * np.eye(3)[longest], float(sides[longest]), radius, volume)
    if geometry.find("mesh") is not None:
        return None
    raise geometry.wrong("<geometry> needs a <sphere>, <capsule>, <cylinder>, <box> or <mesh>")


def _inside(half: Array, length: float, radius: float, volume: float) -> tuple[Array, float]:
    """Returns the capsule of a total length, or the sphere of the volume if wider than long."""
    if length <= 2.0 * radius:
        return np.zeros(3), float(np.cbrt(0.75 * volume / np.pi))
    return half * (length - 2.0 * radius), radius


def _length(element: Element, attribute: str) -> float:
    value = element.number(attribute)
    if value <= 0.0:
        raise element.wrong(f"{attribute} of <{element.tag}> must be positive: {value:g}")
    return value
