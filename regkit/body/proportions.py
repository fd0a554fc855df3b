"""Proportions: ratios of a body's lengths and girths to its template's."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body import BodyDescription
from regkit.body.capsules import deformed_capsule
from regkit.body.deformation import Stretch
from regkit.body.groups import Groups
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.skeleton import SegmentDescription
from regkit.skeleton.description import parents_first
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Proportions:
    """Factors of the template's own lengths.

    Directions in a segment's frame stay the same. The length factor of the segment's group
    stretches along its bone, the girth factor stretches across it and multiplies radii. A trunk's
    girth factor thus also changes the distance of shoulders or hips.

    Attributes:
        groups: Groups of the template's segments.
        lengths: Length factors, (G,).
        girths: Girth factors, (G,).
    """

    groups: Groups
    lengths: Array
    girths: Array

    def applied(self, template: BodyDescription) -> BodyDescription:
        """Returns the template with these proportions, at the size of its new height (along y).

        The result has no mesh and no shape modes, since the template's own do not fit; ``skin``
        returns a mesh.
        """
        order = parents_first(template.segments)
        stretches = {name: self._stretch(index) for index, name in enumerate(order)}
        segments = {
            name: _stretched(segment, stretches[name], stretches.get(segment.parent or ""))
            for name, segment in template.segments.items()
        }
        shapes = {
            key: {
                name: tuple(one.deformed(stretches[name]) for one in several)
                for name, several in by_segment.items()
            }
            for key, by_segment in template.shapes.items()
        }
        sockets = {
            name: one.model_copy(
                update={
                    "offset": stretches[name].point(one.offset),
                    "size": one.size
                    * float(self.lengths[self.groups.of_segments[order.index(name)]]),
                }
            )
            for name, one in template.sockets.items()
        }
        stretched = {"segments": segments, "shapes": shapes, "sockets": sockets}
        subject = template.model_copy(update={**stretched, "mesh": None, "modes": None})
        size = template.size.value * height(subject) / height(template)
        return subject.model_copy(
            update={"size": template.size.model_copy(update={"value": size, "range": (size, size)})}
        )

    def skin(self, template: BodyDescription) -> SkinnedMesh | None:
        """Returns the template's mesh with these proportions; None without a mesh.

        Raises:
            DataError: If the mesh is missing or invalid.
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

    def _stretch(self, segment: int) -> Stretch:
        group = self.groups.of_segments[segment]
        length, girth = float(self.lengths[group]), float(self.girths[group])
        return Stretch.along(self.groups.bones[segment], length, girth)


def _stretched(
    segment: SegmentDescription, own: Stretch, parents: Stretch | None
) -> SegmentDescription:
    return segment.model_copy(
        update={
            "offset": segment.offset if parents is None else parents.point(segment.offset),
            "capsules": tuple(deformed_capsule(one, own) for one in segment.capsules),
            "markers": {name: own.point(point) for name, point in segment.markers.items()},
        }
    )


def height(description: BodyDescription) -> float:
    """Returns the extent of the surface along y in the rest pose [m]."""
    body = description.body("rest", description.size.value)
    placement = body.place(body.skeleton.rest())
    capsules = body.capsules.place(placement.transforms)
    heights = capsules.ends[:, :, 1]
    return float((heights + capsules.radii).max() - (heights - capsules.radii).min())
