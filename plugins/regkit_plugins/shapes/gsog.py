"""G-SoG: the shape model of a generalized sum of Gaussians with full covariances."""

from __future__ import annotations

from typing import ClassVar, Literal

from regkit.body import Body, GaussianParameters, ShapeParameters, gaussians, of_capsules
from regkit.gaussians.surface import Surface, shown
from regkit.interfaces import ListedShapeModel
from regkit.primitives import Gaussians, Primitives


class GeneralizedSumOfGaussians(ListedShapeModel):
    """Generalized sum of Gaussians, eqs. 2 and 3.

    The Gaussians are those that the template lists. If it lists none, each of its capsules becomes
    the Gaussian with the mean and covariance of the solid capsule.
    """

    kind: Literal["gsog"] = "gsog"
    makes: ClassVar[type[Primitives]] = Gaussians
    parameters: ClassVar[type[ShapeParameters] | None] = GaussianParameters

    surface: Surface = "volume"
    """Whether kernels compare data with the whole Gaussian, or with its visible surface."""

    def bind(self, body: Body) -> Gaussians:
        """Returns the template's Gaussians, or those with the moments of its capsules.

        Raises:
            ConfigError: If the template has neither Gaussians nor capsules, or lacks a named list.
        """
        listed = self.listed(body)
        if listed is None:
            listed = of_capsules(self.capsules_of(body), GaussianParameters)
        return shown(Gaussians(*gaussians(listed)), self.surface)
