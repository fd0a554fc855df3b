"""The shape model of a track in a picture."""

from __future__ import annotations

from functools import singledispatch

import numpy as np

from regkit.geometry.rotation import product, to_matrix
from regkit.geometry.surface import vertex_normals
from regkit.system.arrays import Array
from regkit.viewer.animation.canvas import Canvas
from regkit.viewer.animation.ellipsoids import add_ellipsoids
from regkit.viewer.animation.pose import ShownPose
from regkit.viewer.animation.splats import add_splats
from regkit.viewer.animation.view import View
from regkit.viewer.shapes import CapsuleShapes, Dots, Ellipsoids, MeshShape, Shape

APART = 0.4
"""Distance of the spheres that show a capsule, in radii."""

MOST_SPHERES = 16
"""Maximum number of spheres of a capsule."""


ORDER = 3
"""Number of parts into which an edge of a triangle is divided by the discs that show it."""

LATTICE = np.array([
    (i, j, ORDER - i - j) for i in range(ORDER + 1) for j in range(ORDER + 1 - i)
]) / ORDER  # fmt: skip
"""Places of the discs on a triangle, as weights of its corners, (P, 3)."""


@singledispatch
def add_shape(shape: Shape, canvas: Canvas, view: View, pose: ShownPose) -> None:
    """Draws a shape in a pose."""
    raise NotImplementedError(type(shape).__name__)


@add_shape.register
def _(shape: Ellipsoids, canvas: Canvas, view: View, pose: ShownPose) -> None:
    carriers = pose.transforms[shape.segments]
    axes = to_matrix(product(carriers[:, :4], shape.rotations))
    colours = pose.colours[shape.segments]
    add_ellipsoids(canvas, view, shape.placed(pose.transforms), axes, shape.radii, colours)


@add_shape.register
def _(shape: CapsuleShapes, canvas: Canvas, view: View, pose: ShownPose) -> None:
    ends = shape.placed(pose.transforms)
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    counts = np.ceil(lengths / (APART * shape.radii.mean(axis=1))).astype(int) + 1
    counts = np.clip(counts, 1, MOST_SPHERES)
    owners = np.repeat(np.arange(len(ends)), counts)
    along = np.concatenate([np.linspace(0.0, 1.0, count) for count in counts])[:, None]
    centres = (1.0 - along) * ends[owners, 0] + along * ends[owners, 1]
    radii = (1.0 - along[:, 0]) * shape.radii[owners, 0] + along[:, 0] * shape.radii[owners, 1]
    axes = np.broadcast_to(np.eye(3), (len(centres), 3, 3))
    colours = pose.colours[shape.segments[owners]]
    add_ellipsoids(canvas, view, centres, axes, np.repeat(radii[:, None], 3, axis=1), colours)


@add_shape.register
def _(shape: MeshShape, canvas: Canvas, view: View, pose: ShownPose) -> None:
    vertices = shape.placed(pose.transforms)
    main = shape.carriers[np.arange(len(vertices)), shape.weights.argmax(axis=1)]
    normals = vertex_normals(vertices, shape.triangles)
    corners = shape.triangles
    points = (LATTICE @ vertices[corners]).reshape(-1, 3)
    between = (LATTICE @ normals[corners]).reshape(-1, 3)
    between /= np.maximum(np.linalg.norm(between, axis=1, keepdims=True), 1e-9)
    colours = np.repeat(pose.colours[main[corners[:, 0]]], len(LATTICE), axis=0)
    edges = np.linalg.norm(vertices[corners[:, 1]] - vertices[corners[:, 0]], axis=1)
    radius = 0.7 * float(np.percentile(edges, 95.0)) / ORDER
    add_splats(canvas, view, points, between, colours, radius)


@add_shape.register
def _(shape: Dots, canvas: Canvas, view: View, pose: ShownPose) -> None:
    points = shape.placed(pose.transforms)
    colours = pose.colours[shape.segments]
    radius = 0.004 * float(np.ptp(points, axis=0).max(initial=0.0))
    add_splats(canvas, view, points, None, colours, radius)


def extent_of(shapes: tuple[Shape, ...], transforms: Array) -> Array:
    """Returns the points (N, 3) [m] of shapes in a pose, for what must be in sight."""
    placed = [shape.placed(transforms).reshape(-1, 3) for shape in shapes]
    return np.concatenate([*placed, np.zeros((0, 3))])
