"""The skin of a robot: one mesh of all links, each of whose vertices follows one link."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from regkit.geometry.inside import inside
from regkit.geometry.rigid import rigid
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array
from regkit.system.optional import load_library

VERTICES = 4000
"""Number of vertices of a robot's skin, roughly."""

DENSE = 2.0
"""A surface with this many times the triangles of its share is simplified."""

SHARP = np.radians(30.0)
"""An edge between faces that are turned by more than this is sharp [rad]."""

TOUCHING = 1e-4
"""A face that is nearer to another shape than this is in contact with it [m]."""


def robot_skin(
    names: Sequence[str],
    parents: Sequence[int],
    origins: Array,
    surfaces: Mapping[str, Sequence[Array]],
) -> SkinnedMesh | None:
    """Returns the mesh of a robot at rest, with evenly spread vertices; None without a surface.

    What the shapes of one link hide of each other, no camera sees in any pose, and it is left out.

    Args:
        names: Names of the links, parents first.
        parents: Index of each link's parent; -1 for the root.
        origins: Positions of the links at rest, (S, 3) [m]; their frames are parallel.
        surfaces: By link, the corners of the triangles of each of its shapes in its frame,
            (F, 3, 3) [m].
    """
    whole = {name: [_mesh(shape) for shape in shapes] for name, shapes in surfaces.items()}
    extents = {name: sum(float(mesh.area) for mesh in own) ** 0.5 for name, own in whole.items()}
    total = sum(extents.values())
    if total <= 0.0:
        return None
    vertices, faces, owners, count = [], [], [], 0
    for index, name in enumerate(names):
        # An even triangulation of V vertices has 2 V triangles. Links have vertices in proportion
        # to the root of their area, so that small ones, such as fingers, have enough.
        share = extents.get(name, 0.0) * total / (2.0 * VERTICES)
        for part in _visible(whole.get(name, []), share):
            vertices.append(part.vertices + origins[index])
            faces.append(part.faces + count)
            owners.append(np.full(len(part.vertices), index))
            count += len(part.vertices)
    return SkinnedMesh(
        vertices=np.concatenate(vertices),
        faces=np.concatenate(faces).astype(np.intp),
        labels=tuple(names),
        parents=np.array(parents, dtype=np.intp),
        rest=np.array([rigid(np.eye(3), origin) for origin in origins]),
        indices=np.concatenate(owners)[:, None],
        weights=np.ones((count, 1)),
    )


def _mesh(triangles: Array) -> Any:
    """Returns a trimesh of the corners of triangles (F, 3, 3), with equal corners merged."""
    corners = triangles.reshape(-1, 3)
    return load_library("trimesh").Trimesh(corners, np.arange(len(corners)).reshape(-1, 3))


def _visible(meshes: Sequence[Any], share: float) -> Iterator[Any]:
    """Yields what is visible of each shape of a link, with triangles of an area [m^2].

    Vertices on sharp edges are doubled, so that each has the normal of its own side.
    """
    trimesh = load_library("trimesh")
    for mesh in meshes:
        others = [other for other in meshes if other is not mesh and other.is_watertight]
        part = _outside(_even(mesh, share), others)
        if len(part.faces):
            yield trimesh.graph.smooth_shade(part, angle=SHARP)


def _even(mesh: Any, share: float) -> Any:
    """Returns a mesh with triangles of similar sizes.

    Args:
        mesh: The mesh.
        share: Area of a triangle [m^2].
    """
    wanted = max(int(mesh.area / share), 4)
    if len(mesh.faces) > DENSE * wanted:
        mesh = _simplified(mesh, wanted)
    longest = 2.1 * float(np.sqrt(4.0 / np.sqrt(3.0) * share))
    return _mesh(_halved(np.asarray(mesh.triangles), longest))


def _halved(triangles: Array, longest: float) -> Array:
    """Returns triangles (F, 3, 3) [m] whose longest edges are halved until none is too long."""
    fine = []
    while len(triangles):
        edges = np.linalg.norm(np.roll(triangles, -1, axis=1) - triangles, axis=2)
        long = edges.max(axis=1) > longest
        fine.append(triangles[~long])
        # With the longest edge between the first two corners.
        first = (edges[long].argmax(axis=1)[:, None] + np.arange(3)) % 3
        a, b, c = np.take_along_axis(triangles[long], first[:, :, None], axis=1).swapaxes(0, 1)
        middle = 0.5 * (a + b)
        halves = [np.stack(corners, axis=1) for corners in ((a, middle, c), (middle, b, c))]
        triangles = np.concatenate(halves)
    return np.concatenate(fine)


def _simplified(mesh: Any, wanted: int) -> Any:
    """Returns a mesh with a number of triangles, by quadric decimation."""
    library = load_library("open3d")
    fine = library.geometry.TriangleMesh(
        library.utility.Vector3dVector(np.asarray(mesh.vertices)),
        library.utility.Vector3iVector(np.asarray(mesh.faces, dtype=np.int32)),
    )
    coarse = fine.simplify_quadric_decimation(wanted)
    trimesh = load_library("trimesh")
    return trimesh.Trimesh(np.asarray(coarse.vertices), np.asarray(coarse.triangles))


def _outside(mesh: Any, others: Sequence[Any]) -> Any:
    """Returns the faces of a mesh that are in none of the other closed meshes."""
    centres = mesh.triangles_center + TOUCHING * mesh.face_normals
    hidden = np.zeros(len(centres), dtype=np.bool_)
    for other in others:
        hidden |= inside(centres, other.vertices, other.faces)
    return mesh.submesh([np.flatnonzero(~hidden)], append=True) if hidden.any() else mesh
