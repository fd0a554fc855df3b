"""The mesh that displays a body: its skin, its surface, its capsules, or spheres at its joints."""

from __future__ import annotations

import numpy as np

from regkit.body import Body
from regkit.geometry.capsules import Capsules
from regkit.geometry.rigid import transformed
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interchange.gltf.capsule_mesh import capsule_mesh
from regkit.system.arrays import Array, Indices
from regkit.system.errors import DataError

DOT = 0.02
"""Radius of the sphere that displays a joint, as a fraction of the body's size."""


def shown_mesh(body: Body, skin: SkinnedMesh | None) -> SkinnedMesh:
    """Returns a mesh whose bones are the body's segments, in the same order.

    It is the skin if there is one; else the surface if its vertices have one segment each, as of a
    cloud; else the capsules; else spheres at the joints.

    Args:
        body: The body.
        skin: Its mesh, if it has one.

    Raises:
        DataError: If a bone of the skin is not a segment.
    """
    if skin is not None:
        return _on_segments(body, skin)
    if body.surface is not None and body.surface.segments.shape[1] == 1:
        surface = body.surface
        return _rigid_parts(body, surface.points[:, 0], surface.faces, surface.segments[:, 0])
    capsules = body.capsules if len(body.capsules) else _dots(body)
    vertices, faces, owners = capsule_mesh(capsules)
    return _rigid_parts(body, vertices, faces, capsules.segments[owners])


def _dots(body: Body) -> Capsules:
    count = len(body.skeleton.names)
    radii = np.full((count, 2), DOT * body.size)
    return Capsules(np.arange(count), np.zeros((count, 2, 3)), radii)


def _rigid_parts(body: Body, points: Array, faces: Indices, segments: Indices) -> SkinnedMesh:
    """Returns the mesh of points (V, 3) [m] in the frames of their segments (V,)."""
    rest = body.place(body.skeleton.rest()).transforms
    return SkinnedMesh(
        vertices=transformed(rest[segments], points),
        faces=faces,
        labels=body.skeleton.names,
        parents=body.skeleton.parents,
        rest=rest,
        indices=segments[:, None],
        weights=np.ones((len(points), 1)),
    )


def _on_segments(body: Body, skin: SkinnedMesh) -> SkinnedMesh:
    names = body.skeleton.names
    order = np.zeros(len(skin.labels), dtype=np.intp)
    rest = body.place(body.skeleton.rest()).transforms.copy()
    for bone in np.unique(skin.indices[skin.weights > 0.0]):
        label = skin.labels[bone]
        if label not in names:
            raise DataError(
                f"the mesh's bone '{label}' is not a segment of '{body.name}' (there are: "
                f"{', '.join(names)})"
            )
        order[bone] = names.index(label)
        rest[order[bone]] = skin.rest[bone]
    return SkinnedMesh(
        vertices=skin.vertices,
        faces=skin.faces,
        labels=names,
        parents=body.skeleton.parents,
        rest=rest,
        indices=order[skin.indices],
        weights=skin.weights,
    )
