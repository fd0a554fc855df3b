"""The shapes of a registrar's primitives and of its body's mesh."""

from __future__ import annotations

import numpy as np
import scipy

from regkit.body import Body
from regkit.geometry.rotation import IDENTITY, from_matrix
from regkit.geometry.surface import SkinnedSurface
from regkit.interfaces import Registrar
from regkit.primitives import Gaussians, Primitives, TaperedCapsules, Volumes
from regkit.system.arrays import Array, Indices
from regkit.viewer.shapes import CapsuleShapes, Dots, Ellipsoids, MeshShape, Shape

SIGMAS = 2.0
"""Radius of the ellipsoid that shows a Gaussian, in standard deviations."""

MOST_SOLIDS = 2000
"""Maximum number of solids; of more, as a cloud's, the centres are shown."""

MOST_TRIANGLES = 30_000
"""Maximum number of triangles of a mesh that is shown."""

MOST_DOTS = 4000
"""Maximum number of points of a model."""


def shapes_of(registrar: Registrar) -> tuple[Shape, ...]:
    """Returns the shape model of a registrar, then the mesh of its body if that is another."""
    body = registrar.body
    model = model_shape(registrar.primitives, len(body.skeleton.names))
    surface = body.surface
    if surface is None or not 0 < len(surface.faces) <= MOST_TRIANGLES:
        return (model,)
    mesh = _mesh(body, surface)
    # The vertices of a mesh are better seen as its surface.
    return (mesh,) if isinstance(model, Dots) else (model, mesh)


def transforms_of(matrices: Array) -> Array:
    """Returns quaternions (x, y, z, w) and origins (..., 7) of rigid motions (..., 4, 4)."""
    return np.concatenate([from_matrix(matrices[..., :3, :3]), matrices[..., :3, 3]], axis=-1)


def model_shape(primitives: Primitives, segments: int) -> Shape:
    """Returns the shape of primitives: Gaussians as ellipsoids, capsules, solids, or points.

    Args:
        primitives: The primitives.
        segments: Number S of segments.
    """
    carriers, count = primitives.segments, len(primitives)
    if isinstance(primitives, Volumes) and count <= MOST_SOLIDS:
        if isinstance(primitives, TaperedCapsules):
            half = primitives.halves[:, None] * primitives.axes[:, :, 1]
            ends = np.stack([primitives.centres - half, primitives.centres + half], axis=1)
            return CapsuleShapes(carriers, ends, primitives.radii)
        if isinstance(primitives, Gaussians):
            rotations = from_matrix(primitives.axes)
            return Ellipsoids(carriers, primitives.centres, rotations, SIGMAS * primitives.scales)
        return _hulls(primitives, segments)
    every = -(-count // MOST_DOTS)
    return Dots(carriers[::every], primitives.centres[::every])


def _hulls(solids: Volumes, segments: int) -> MeshShape:
    """Returns the convex hulls of other solids, as one mesh in the segments' frames."""
    surfaces = solids.surface_points()
    count = surfaces.shape[1]
    placed = solids.centres[:, None] + surfaces @ np.swapaxes(solids.axes, 1, 2)
    triangles = [one * count + _hull(points) for one, points in enumerate(surfaces)]
    carriers = np.repeat(solids.segments, count)
    return _rigid(placed.reshape(-1, 3), np.concatenate(triangles), carriers, segments)


def _hull(points: Array) -> Indices:
    """Returns the triangles (T, 3) of the convex hull of points (N, 3), outside up."""
    hull = scipy.spatial.ConvexHull(points)
    corners: Indices = hull.simplices.astype(np.intp)
    a, b, c = points[corners].transpose(1, 0, 2)
    inward = (np.cross(b - a, c - a) * hull.equations[:, :3]).sum(axis=1) < 0.0
    return np.where(inward[:, None], corners[:, ::-1], corners)


def _rigid(vertices: Array, triangles: Indices, carriers: Indices, segments: int) -> MeshShape:
    """Returns a mesh whose vertices are in the frames of one of S segments each."""
    rest = np.tile([*IDENTITY, 0.0, 0.0, 0.0], (segments, 1))
    return MeshShape(vertices, triangles, carriers[:, None], np.ones((len(vertices), 1)), rest)


def _mesh(body: Body, surface: SkinnedSurface) -> MeshShape:
    """Returns a body's skinned mesh."""
    rest = surface.rest
    if rest is None:
        main = np.arange(len(surface)), surface.blend.argmax(axis=1)
        count = len(body.skeleton.names)
        return _rigid(surface.points[main], surface.faces, surface.segments[main], count)
    vertices = surface.place(rest)
    return MeshShape(vertices, surface.faces, surface.segments, surface.blend, transforms_of(rest))
