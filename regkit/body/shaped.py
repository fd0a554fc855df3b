"""A template in another shape: everything in its segments follows the displacement of its skin."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body.capsules import CapsuleParameters, deformed_capsule
from regkit.body.deformation import Deformation
from regkit.body.description import BodyDescription
from regkit.body.linear_shape import LinearShape
from regkit.body.parts import SocketDescription
from regkit.body.vectors import vector
from regkit.geometry.rotation import vector_to_matrix
from regkit.geometry.warp import Warp
from regkit.skeleton import SegmentDescription
from regkit.skeleton.description import CapsuleDescription
from regkit.skeleton.joints import Vector
from regkit.system.arrays import Array

EXTENT = 0.015
"""Distance within which vertices determine the displacement of a point alike, as a fraction of the
body's size."""

JOINT = 50.0
"""Weight of a joint among the vertices: what lies at a joint moves with it."""

OWN = 0.3
"""Least skinning weight of a vertex that a segment's parts follow."""


def shaped(shape: LinearShape, x: Array) -> BodyDescription:
    """Returns the template with the coefficients x (P,), at the size that it has with them.

    Joints are displaced as the modes say. Capsules, markers and primitives follow the skin of their
    segment. The result has no mesh and no modes, since the template's own do not fit;
    ``LinearShape.skin`` returns the mesh.

    Raises:
        ConfigError: If the template lists a shape model that cannot be loaded.
    """
    template, size = shape.template, shape.size(x)
    template.check_shapes()
    names = shape.mesh.labels
    warps = {name: _warp(shape, x, segment) for segment, name in enumerate(names)}
    moved = np.tensordot(x, shape.offsets, 1)
    segments = {
        name: _shaped(segment, warps[name], moved[names.index(name)])
        for name, segment in template.segments.items()
    }
    shapes = {
        key: {
            name: tuple(one.deformed(_Surroundings.of(warps[name], *one.moments())) for one in all_)
            for name, all_ in by_segment.items()
        }
        for key, by_segment in template.shapes.items()
    }
    sockets = {name: _socket(socket, warps[name]) for name, socket in template.sockets.items()}
    return template.model_copy(
        update={
            "segments": segments,
            "shapes": shapes,
            "sockets": sockets,
            "mesh": None,
            "modes": None,
            "size": template.size.model_copy(update={"value": size, "range": (size, size)}),
        }
    )


def _warp(shape: LinearShape, x: Array, segment: int) -> Warp:
    """Returns the displacement of a segment's surroundings, in its frame."""
    surface = shape.own
    vertices, carriers = np.nonzero((surface.segments == segment) & (surface.blend > OWN))
    children = np.flatnonzero(shape.mesh.parents == segment)
    offsets = [shape.template.segments[shape.mesh.labels[child]].offset for child in children]
    joints = np.array([(0.0, 0.0, 0.0), *offsets])
    moved = np.tensordot(x, shape.offsets[:, children], 1)
    displaced = np.tensordot(x, shape.points[:, vertices, carriers], 1)
    return Warp(
        points=np.concatenate([surface.points[vertices, carriers], joints]),
        displacements=np.concatenate([displaced, np.zeros((1, 3)), moved]),
        weights=np.concatenate(
            [surface.blend[vertices, carriers], np.full(1 + len(children), JOINT)]
        ),
        extent=EXTENT * shape.template.size.value,
    )


@dataclass(frozen=True)
class _Surroundings(Deformation):
    """The displacement around something in a segment: points by the warp, sizes by its linear part.

    Attributes:
        warp: The displacement of the segment's points.
        matrix: Linear map around the centre, (3, 3).
        girth: Factor of radii.
    """

    warp: Warp
    matrix: Array
    girth: float

    @classmethod
    def of(cls, warp: Warp, centre: Array, covariance: Array) -> _Surroundings:
        """Returns the surroundings of a solid with a mean (3,) [m] and covariance (3, 3) [m^2].

        A radius grows as the extents across the solid do.
        """
        _, matrix = warp.at(centre)
        variances, axes = np.linalg.eigh(covariance)
        thin = 1.0 / np.maximum(variances, 1e-12)
        stretches = np.linalg.norm(matrix @ axes, axis=0)
        return cls(warp, matrix, float(thin @ stretches / thin.sum()))

    def point(self, point: Vector) -> Vector:
        """Returns the displaced point [m]."""
        return vector(self.warp.at(np.array(point))[0])

    def radius(self, radius: float) -> float:
        """Returns the radius multiplied by the girth [m]."""
        return self.girth * radius

    def extents(self, extents: Vector, rotation_deg: Vector) -> Vector:
        """Returns the stretched lengths of the axes, which keep their directions [m]."""
        axes = vector_to_matrix(np.radians(rotation_deg))
        return vector(np.linalg.norm(self.matrix @ axes, axis=0) * extents)

    def rotation(self, rotation_deg: Vector) -> Vector:
        """Returns the same rotation [deg]."""
        return rotation_deg


def _shaped(segment: SegmentDescription, warp: Warp, moved: Array) -> SegmentDescription:
    return segment.model_copy(
        update={
            "offset": vector(np.array(segment.offset) + moved),
            "capsules": tuple(_capsule(one, warp) for one in segment.capsules),
            "markers": {
                name: vector(warp.at(np.array(at))[0]) for name, at in segment.markers.items()
            },
        }
    )


def _socket(socket: SocketDescription, warp: Warp) -> SocketDescription:
    """Returns a socket whose part grows as the segment does that it replaces."""
    _, matrix = warp.at(warp.points.mean(axis=0))
    image, _ = warp.at(np.array(socket.offset))
    growth = float(np.cbrt(np.linalg.det(matrix)))
    return socket.model_copy(update={"offset": vector(image), "size": growth * socket.size})


def _capsule(capsule: CapsuleDescription, warp: Warp) -> CapsuleDescription:
    solid = CapsuleParameters(start=capsule.start, end=capsule.end, radius=capsule.radius)
    return deformed_capsule(capsule, _Surroundings.of(warp, *solid.moments()))
