"""Approximation of the shapes of URDF links by capsules."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.interchange.bones import vector
from regkit.interchange.remarks import Remarks
from regkit.interchange.urdf.joints import origin
from regkit.interchange.urdf.link_surface import LinkSurfaces
from regkit.interchange.urdf.mesh_capsule import mesh_capsule
from regkit.interchange.urdf.urdf import UrdfLink
from regkit.interchange.urdf.xml_lines import Element
from regkit.skeleton.description import CapsuleDescription
from regkit.system.arrays import Array

SMALLEST = 1e-6
"""A shape with a smaller radius has no extent [m]."""

Core = tuple[Array, Array, float]
"""The ends (3,) of a capsule's axis, and its radius [m]."""


@dataclass(frozen=True)
class LinkShapes:
    """The capsules of a robot's links.

    Spheres and capsules are exact. A cylinder becomes the inscribed capsule of the same length and
    radius; a cylinder that is shorter than wide, and a cube, the sphere of equal volume. A box
    becomes a capsule along its longest side with the box's cross-sectional area. A mesh becomes the
    capsule of ``mesh_capsule``.

    Attributes:
        surfaces: Reads the meshes.
        remarks: Takes what is passed over.
    """

    surfaces: LinkSurfaces
    remarks: Remarks

    def capsules(
        self, link: UrdfLink, T_bone_link: Array, scale: float
    ) -> tuple[CapsuleDescription, ...]:
        """Returns the capsules of a link in a bone's frame, of the visual shapes if no other is.

        Args:
            link: The link.
            T_bone_link: Transform from the link's frame to the bone's, (4, 4) [m].
            scale: Metres per unit of the file.

        Raises:
            DataError: If a length is missing or negative.
        """
        for shapes in (link.collision, link.visual):
            cores = [(shape, self._core(shape)) for shape in shapes]
            capsules = []
            for shape, core in cores:
                if core is None:
                    continue
                T_bone_shape = T_bone_link @ origin(shape)
                start, end = (
                    vector(scale * (T_bone_shape[:3, :3] @ point + T_bone_shape[:3, 3]))
                    for point in core[:2]
                )
                capsules.append(CapsuleDescription(start=start, end=end, radius=scale * core[2]))
            if capsules:
                return tuple(capsules)
        return ()

    def _core(self, shape: Element) -> Core | None:
        """Returns the capsule of a shape; None if it has no extent, or cannot be read."""
        geometry = shape.find("geometry")
        found = None if geometry is None else _first_known(geometry)
        if found is None:
            tags = "nothing" if geometry is None else [one.tag for one in geometry.children]
            self.remarks.add("shapes of unknown kinds are passed over", f"{tags}", shape.place)
            return None
        core = self._mesh(found) if found.tag == "mesh" else _CORES[found.tag](found)
        if core is not None and core[2] < SMALLEST:
            lengths = " ".join(f'{key}="{text}"' for key, text in found.attributes.items())
            self.remarks.add(
                "shapes without extent are passed over", f"{found.tag} {lengths}", found.place
            )
            return None
        return core

    def _mesh(self, mesh: Element) -> Core | None:
        triangles = self.surfaces.mesh(mesh)
        return None if triangles is None else mesh_capsule(triangles)


def _first_known(geometry: Element) -> Element | None:
    return next((one for one in geometry.children if one.tag in (*_CORES, "mesh")), None)


def _sphere(sphere: Element) -> Core:
    return np.zeros(3), np.zeros(3), _length(sphere, "radius")


def _capsule(capsule: Element) -> Core:
    # The length is the distance between the centres of the end spheres.
    half = np.array([0.0, 0.0, 0.5 * _length(capsule, "length")])
    return -half, half, _length(capsule, "radius")


def _cylinder(cylinder: Element) -> Core:
    length, radius = _length(cylinder, "length"), _length(cylinder, "radius")
    return _inside(np.array([0.0, 0.0, 0.5]), length, radius, np.pi * radius**2 * length)


def _box(box: Element) -> Core:
    sides = box.numbers("size", 3)
    if (sides < 0.0).any():
        raise box.wrong(f"the sides of a box must be positive: {sides.tolist()}")
    longest = int(np.argmax(sides))
    volume = float(np.prod(sides))
    radius = float(np.sqrt(volume / max(sides[longest], SMALLEST) / np.pi))
    return _inside(0.5 * np.eye(3)[longest], float(sides[longest]), radius, volume)


_CORES = {"sphere": _sphere, "capsule": _capsule, "cylinder": _cylinder, "box": _box}
"""The capsule of an element, by its tag."""


def _inside(half: Array, length: float, radius: float, volume: float) -> Core:
    """Returns the capsule of a total length, or the sphere of the volume if wider than long."""
    if length <= 2.0 * radius:
        return np.zeros(3), np.zeros(3), float(np.cbrt(0.75 * volume / np.pi))
    end = half * (length - 2.0 * radius)
    return -end, end, radius


def _length(element: Element, attribute: str) -> float:
    value = element.number(attribute)
    if value < 0.0:
        raise element.wrong(f"{attribute} of <{element.tag}> must be positive: {value:g}")
    return value
