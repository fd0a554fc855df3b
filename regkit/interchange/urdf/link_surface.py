"""The surfaces of URDF links as triangles: boxes, cylinders, spheres, capsules and meshes."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial

import numpy as np

from regkit.geometry.rigid import transformed
from regkit.interchange.remarks import Remarks
from regkit.interchange.urdf.joints import origin
from regkit.interchange.urdf.mesh_capsule import read_triangles
from regkit.interchange.urdf.mesh_files import MeshFiles
from regkit.interchange.urdf.urdf import UrdfLink
from regkit.interchange.urdf.xml_lines import Element
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.optional import load_library

SECTIONS = 32
"""Number of sides of the prism in the place of a cylinder."""

SUBDIVISIONS = 3
"""How often the triangles of an icosahedron are divided in the place of a sphere."""


SMALLEST = 1e-6
"""A shape with a smaller length has no extent [m]."""


@dataclass(frozen=True)
class LinkSurfaces:
    """The surfaces of a robot's links, as a camera sees them.

    Attributes:
        files: Finds the files of meshes.
        remarks: Takes what is passed over.
    """

    files: MeshFiles
    remarks: Remarks
    _triangles: dict[str, Array | None] = field(default_factory=dict)

    def triangles(self, link: UrdfLink, T_bone_link: Array, scale: float) -> list[Array]:
        """Returns the surfaces of a link in a bone's frame, of its collision shapes if no other is.

        Args:
            link: The link.
            T_bone_link: Transform from the link's frame to the bone's, (4, 4) [m].
            scale: Metres per unit of the file.

        Returns:
            The corners of the triangles of each shape, (F, 3, 3) [m], counter-clockwise seen from
            outside.
        """
        for shapes in (link.visual, link.collision):
            found = [(shape, self.of(shape)) for shape in shapes]
            placed = [
                scale * transformed(T_bone_link @ origin(shape), corners.reshape(-1, 3))
                for shape, corners in found
                if corners is not None
            ]
            known = [with_area(corners.reshape(-1, 3, 3)) for corners in placed]
            if any(map(len, known)):
                return [corners for corners in known if len(corners)]
        return []

    def of(self, shape: Element) -> Array | None:
        """Returns the triangles of a shape in its own frame, (F, 3, 3); None if it has none."""
        geometry = shape.find("geometry")
        if geometry is None:
            return None
        for one in geometry.children:
            if one.tag == "mesh":
                return self.mesh(one)
            if one.tag in _SOLIDS:
                return _solid(one)
        return None

    def mesh(self, mesh: Element) -> Array | None:
        """Returns the triangles of a mesh, (F, 3, 3); None if its file cannot be read."""
        address = mesh.text("filename")
        if address not in self._triangles:
            self._triangles[address] = self._read(address, mesh)
        triangles = self._triangles[address]
        if triangles is None:
            return None
        scales = mesh.numbers("scale", 3, np.ones(3))
        # A mirrored mesh would be inside out.
        ordered = triangles if np.prod(scales) > 0.0 else triangles[:, ::-1]
        return np.asarray(ordered * scales)

    def _read(self, address: str, mesh: Element) -> Array | None:
        path = self.files.find(address)
        if path is None:
            self.remarks.add(
                "meshes are missing, and links without another shape get a capsule along each "
                "bone; name the folder of the package",
                address,
                mesh.place,
            )
            return None
        try:
            return read_triangles(path)
        except DataError as error:
            self.remarks.add("meshes cannot be read, and are passed over", f"{error}", mesh.place)
            return None


def with_area(triangles: Array) -> Array:
    """Returns the triangles (F, 3, 3) that have an area."""
    edges = triangles[:, 1:] - triangles[:, :1]
    areas = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
    return np.asarray(triangles[areas > 0.0])


_SOLIDS = ("box", "cylinder", "sphere", "capsule")
"""Tags of the shapes that are described by their lengths."""


def _solid(shape: Element) -> Array | None:
    """Returns the triangles of a box, cylinder, sphere or capsule; None if it has no extent.

    Raises:
        DataError: If a length is missing.
    """
    creation = load_library("trimesh").creation
    if shape.tag == "box":
        lengths = shape.numbers("size", 3).tolist()
        make = partial(creation.box, extents=lengths)
    elif shape.tag == "sphere":
        lengths = [shape.number("radius")]
        make = partial(creation.icosphere, subdivisions=SUBDIVISIONS, radius=lengths[0])
    else:
        # The length of a capsule is the distance between the centres of its end spheres.
        lengths = [shape.number("radius"), shape.number("length")]
        maker = creation.cylinder if shape.tag == "cylinder" else creation.capsule
        words = {"sections": SECTIONS} if shape.tag == "cylinder" else {}
        make = partial(maker, radius=lengths[0], height=lengths[1], **words)
    if min(lengths) < SMALLEST:
        return None
    return np.asarray(make().triangles, dtype=np.float64)
