"""SoG: the shape model of a sum of isotropic Gaussians."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from regkit.body import BallParameters, Body, ShapeParameters, ellipsoids
from regkit.geometry.capsules import Capsules
from regkit.interfaces import ShapeModel
from regkit.primitives import Gaussians, Primitives
from regkit.system.errors import ConfigError
from regkit_plugins.shapes.surface import Surface, shown


class SumOfGaussians(ShapeModel):
    """Sum of isotropic Gaussians, eqs. 1 and 2.

    The Gaussians are those that the template lists. If it lists none, they are placed along its
    capsules, with half the capsule's radius as standard deviation (that of a solid cylinder across
    its axis).
    """

    kind: Literal["sog"] = "sog"
    makes: ClassVar[type[Primitives]] = Gaussians
    parameters: ClassVar[type[ShapeParameters] | None] = BallParameters

    surface: Surface = "volume"
    """Whether kernels compare data with the whole Gaussian, or with its visible surface."""

    def bind(self, body: Body) -> Gaussians:
        """Returns the template's isotropic Gaussians, or Gaussians along its capsules.

        Raises:
            ConfigError: If the template has neither Gaussians nor capsules.
        """
        listed = body.shapes.get(self.kind)
        if listed is None:
            return shown(_strung_along(body.capsules, body.name), self.surface)
        return shown(Gaussians(*ellipsoids(listed)), self.surface)


def _strung_along(capsules: Capsules, name: str) -> Gaussians:
    """Returns Gaussians on the axes of capsules, about one mean radius apart."""
    if not len(capsules):
        raise ConfigError(
            f"the template '{name}' has neither shapes.sog nor capsules, which shape 'sog' needs"
        )
    segments, centres, radii = [], [], []
    for segment, (start, end), (first, last) in zip(
        capsules.segments, capsules.ends, capsules.radii, strict=True
    ):
        count = max(1, round(float(np.linalg.norm(end - start)) / (0.5 * (first + last))))
        along = (np.arange(count) + 0.5) / count
        segments += [segment] * count
        centres += list(start + along[:, None] * (end - start))
        radii += list(first + along * (last - first))
    return Gaussians(
        segments=np.array(segments, dtype=np.intp),
        centres=np.array(centres),
        axes=np.tile(np.eye(3), (len(segments), 1, 1)),
        scales=np.repeat(0.5 * np.array(radii)[:, None], 3, axis=1),
        weights=np.ones(len(segments)),
    )
