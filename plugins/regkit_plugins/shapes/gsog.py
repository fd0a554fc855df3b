"""G-SoG: the shape model of a generalized sum of Gaussians with full covariances."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from regkit.body import Body, GaussianParameters, ShapeParameters, gaussians
from regkit.gaussians.surface import Surface, shown
from regkit.geometry.capsule_moments import capsule_moments
from regkit.interfaces import ListedShapeModel
from regkit.primitives import Gaussians, Primitives
from regkit.system.errors import ConfigError


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
        own = _moments_of(body) if listed is None else Gaussians(*gaussians(listed))
        return shown(own, self.surface)


def _moments_of(body: Body) -> Gaussians:
    capsules = body.capsules
    if not len(capsules):
        raise ConfigError(
            f"the template '{body.name}' has neither shapes.gsog nor capsules, which shape 'gsog' "
            "needs"
        )
    moments = [
        capsule_moments(ends, radii)
        for ends, radii in zip(capsules.ends, capsules.radii, strict=True)
    ]
    return Gaussians(
        segments=capsules.segments,
        centres=np.array([centre for centre, _, _ in moments]),
        axes=np.array([axes for _, axes, _ in moments]),
        scales=np.array([scales for _, _, scales in moments]),
        weights=np.ones(len(moments)),
    )
