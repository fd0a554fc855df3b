"""Proportions: by how much the lengths and the girths of a body differ from its template's."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body import BodyDescription
from regkit.body.description import GaussianDescription
from regkit.body.groups import Groups
from regkit.geometry.rotation import vector_to_matrix
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.skeleton import SegmentDescription
from regkit.skeleton.description import CapsuleDescription, parents_first
from regkit.skeleton.joints import Vector
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Proportions:
    """Factors on the template's own lengths.

    A segment keeps the directions of everything in its frame, but is stretched: along its bone by
    its group's length factor, across it, and in its radii, by its girth factor. So a trunk's girth
    is also the distance of its shoulders or hips.

    Attributes:
        groups: The groups of the template's segments.
        lengths: (G,).
        girths: (G,).
    """

    groups: Groups
    lengths: Array
    girths: Array

    def applied(self, template: BodyDescription) -> BodyDescription:
        """The template with these proportions; its size is what its height (along y) became.

        It has no mesh: the template's own would not fit it, but ``skin`` does.
        """
        order = parents_first(template.segments)
        stretches = {name: self._stretch(index) for index, name in enumerate(order)}
        segments = {
            name: _stretched(segment, stretches[name], stretches.get(segment.parent or ""))
            for name, segment in template.segments.items()
        }
        gaussians = {
            kind: {
                name: tuple(_swollen(one, stretches[name]) for one in several)
                for name, several in by_segment.items()
            }
            for kind, by_segment in template.gaussians.items()
        }
        subject = template.model_copy(
            update={"segments": segments, "gaussians": gaussians, "mesh": None}
        )
        size = template.size.value * height(subject) / height(template)
        return subject.model_copy(
            update={"size": template.size.model_copy(update={"value": size, "range": (size, size)})}
        )

    def skin(self, template: BodyDescription) -> SkinnedMesh | None:
        """The template's mesh with these proportions, if it has one.

        Raises:
            DataError: If the mesh is missing or wrong.
        """
        if template.mesh is None:
            return None
        mesh = SkinnedMesh.read(template.mesh)
        order = parents_first(template.segments)
        return mesh.stretched(
            np.array(
                [
                    self._stretch(order.index(label)).matrix if label in order else np.eye(3)
                    for label in mesh.labels
                ]
            )
        )

    def _stretch(self, segment: int) -> _Stretch:
        group = self.groups.of_segments[segment]
        bone = self.groups.bones[segment]
        length, girth = float(self.lengths[group]), float(self.girths[group])
        return _Stretch(girth * np.eye(3) + (length - girth) * np.outer(bone, bone), girth)


@dataclass(frozen=True)
class _Stretch:
    """What happens in a segment's frame: a matrix (3, 3) on positions, a factor on radii."""

    matrix: Array
    girth: float

    def point(self, point: Vector) -> Vector:
        return _vector(self.matrix @ point)

    def radius(self, radius: float | tuple[float, float]) -> float | tuple[float, float]:
        if isinstance(radius, tuple):
            return (self.girth * radius[0], self.girth * radius[1])
        return self.girth * radius


def _stretched(
    segment: SegmentDescription, own: _Stretch, parents: _Stretch | None
) -> SegmentDescription:
    capsules = tuple(
        CapsuleDescription.model_construct(
            start=own.point(capsule.start),
            end=own.point(capsule.end),
            radius=own.radius(capsule.radius),
        )
        for capsule in segment.capsules
    )
    return segment.model_copy(
        update={
            "offset": segment.offset if parents is None else parents.point(segment.offset),
            "capsules": capsules,
            "markers": {name: own.point(point) for name, point in segment.markers.items()},
        }
    )


def _swollen(gaussian: GaussianDescription, stretch: _Stretch) -> GaussianDescription:
    """A Gaussian whose own axes keep their directions; a sphere stays one."""
    if isinstance(gaussian.sigma, float):
        sigma: float | Vector = stretch.girth * gaussian.sigma
    else:
        axes = vector_to_matrix(np.radians(gaussian.rotation_deg))
        sigma = _vector(np.linalg.norm(stretch.matrix @ axes, axis=0) * gaussian.sigma)
    return gaussian.model_copy(update={"centre": stretch.point(gaussian.centre), "sigma": sigma})


def height(description: BodyDescription) -> float:
    """How far the surface reaches along y in the rest pose [m]."""
    body = description.body("rest", description.size.value)
    placement = body.place(body.skeleton.rest())
    capsules = body.capsules.place(placement.transforms)
    heights = capsules.ends[:, :, 1]
    return float((heights + capsules.radii).max() - (heights - capsules.radii).min())


def _vector(values: Array) -> Vector:
    x, y, z = values.tolist()
    return (x, y, z)
