"""The shape model of a sphere-mesh: tapered capsules, or spheres along them."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from regkit.body import Body, CapsuleParameters, ShapeParameters, capsules
from regkit.geometry.capsules import Capsules
from regkit.interfaces import ListedShapeModel
from regkit.primitives import Primitives, TaperedCapsules


class SphereMesh(ListedShapeModel):
    """Capsules, or spheres along them.

    The capsules are those that the template lists for this shape; if it lists none, those of its
    segments.

    The variant ``capsules`` is the sphere-mesh of Tkach, Pauly and Tagliasacchi (Sphere-meshes for
    real-time hand modeling and tracking, 2016), with pills only and no wedges. The variant
    ``spheres`` is the model of Qian, Sun, Wei, Tang and Sun (Realtime and robust hand tracking from
    depth, 2014).
    """

    kind: Literal["sphere"] = "sphere"
    makes: ClassVar[type[Primitives]] = TaperedCapsules
    parameters: ClassVar[type[ShapeParameters] | None] = CapsuleParameters

    variant: Literal["capsules", "spheres"] = "capsules"
    """Whether the primitives are tapered capsules, or spheres along their axes."""
    spacing: Annotated[float, Field(ge=1e-3, le=100.0)] = 1.0
    """Distance of neighbouring spheres, as a fraction of their radius; for ``spheres`` only."""

    def bind(self, body: Body) -> TaperedCapsules:
        """Returns the template's capsules, or spheres on their axes.

        Raises:
            ConfigError: If the template has no capsules, or lacks a named list.
        """
        listed = self.listed(body)
        own = self.capsules_of(body) if listed is None else capsules(listed)
        return _joined(_strung_along(own, self.spacing) if self.variant == "spheres" else own)


def _strung_along(capsules: Capsules, spacing: float) -> Capsules:
    """Returns spheres along each capsule, as capsules of zero length."""
    owners, along = [], []
    for index, (ends, radii) in enumerate(zip(capsules.ends, capsules.radii, strict=True)):
        length = float(np.linalg.norm(ends[1] - ends[0]))
        count = 1 + int(np.ceil(length / (spacing * radii.mean())))
        owners += [index] * count
        along += list(np.linspace(0.0, 1.0, count))
    own, share = np.array(owners, dtype=np.intp), np.array(along)[:, None]
    centres = (1.0 - share) * capsules.ends[own, 0] + share * capsules.ends[own, 1]
    radii = (1.0 - share) * capsules.radii[own, :1] + share * capsules.radii[own, 1:]
    return Capsules(
        capsules.segments[own], np.repeat(centres[:, None], 2, axis=1), np.repeat(radii, 2, axis=1)
    )


def _joined(capsules: Capsules) -> TaperedCapsules:
    """Returns capsules as primitives."""
    ends, radii = capsules.ends.copy(), capsules.radii.copy()
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    # If one sphere contains the other, the capsule is the larger sphere.
    contained = np.flatnonzero(np.abs(radii[:, 1] - radii[:, 0]) >= lengths)
    larger = radii[contained].argmax(axis=1)
    ends[contained] = ends[contained, larger, None]
    radii[contained] = radii[contained, larger, None]
    halves = 0.5 * np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    across = 0.5 * radii.mean(axis=1)
    along = 0.5 * (halves + radii.mean(axis=1))
    return TaperedCapsules(
        segments=capsules.segments,
        centres=ends.mean(axis=1),
        axes=Capsules(capsules.segments, ends, radii).frames(),
        scales=np.column_stack([across, along, across]),
        weights=np.ones(len(capsules)),
        halves=halves,
        radii=radii,
    )
