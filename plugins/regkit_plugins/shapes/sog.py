"""SoG: the shape model of a sum of isotropic Gaussians."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from regkit.body import Body, IsotropicGaussianParameters, ShapeParameters, gaussians
from regkit.gaussians.surface import Surface, shown
from regkit.geometry.capsules import Capsules
from regkit.interfaces import ListedShapeModel
from regkit.primitives import Gaussians, Primitives


class SumOfGaussians(ListedShapeModel):
    """Sum of isotropic Gaussians, eqs. 1 and 2.

    The Gaussians are those that the template lists. If it lists none, they are placed along its
    capsules, with half the capsule's radius as standard deviation (that of a solid cylinder across
    its axis).
    """

    kind: Literal["sog"] = "sog"
    makes: ClassVar[type[Primitives]] = Gaussians
    parameters: ClassVar[type[ShapeParameters] | None] = IsotropicGaussianParameters

    surface: Surface = "volume"
    """Whether kernels compare data with the whole Gaussian, or with its visible surface."""

    def bind(self, body: Body) -> Gaussians:
        """Returns the template's isotropic Gaussians, or Gaussians along its capsules.

        Raises:
            ConfigError: If the template has neither Gaussians nor capsules, or lacks a named list.
        """
        listed = self.listed(body)
        if listed is None:
            return shown(_strung_along(self.capsules_of(body)), self.surface)
        return shown(Gaussians(*gaussians(listed)), self.surface)


def _strung_along(capsules: Capsules) -> Gaussians:
    """Gaussians about one mean radius apart on the axes of capsules."""
    lengths = np.linalg.norm(capsules.ends[:, 1] - capsules.ends[:, 0], axis=1)
    counts = np.maximum(1, np.rint(lengths / capsules.radii.mean(axis=1)).astype(np.intp))
    axes = capsules.axis_parts(counts)
    return Gaussians.isotropic(axes.segments, axes.points, 0.5 * axes.radii)
