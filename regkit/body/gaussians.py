"""Parameters of weighted Gaussians that a template lists for a shape model."""

from __future__ import annotations

from typing import Annotated, Self

import numpy as np
from pydantic import Field

from regkit.body.ellipsoids import BallParameters, EllipsoidParameters
from regkit.body.freedoms import Freedom
from regkit.system.arrays import Array

Weight = Annotated[float, Field(ge=1e-4, le=1e4)]
"""A weight that four decimals can tell from zero."""


class GaussianParameters(EllipsoidParameters):
    """A Gaussian in a segment's frame, ``weight * exp(-1/2 (x - m)^T C^-1 (x - m))``."""

    weight: Weight = 1.0
    """Height of the Gaussian at its mean, relative to those of the others."""

    def freedoms(self) -> tuple[Freedom, ...]:
        """Returns the free parameters of the solid, and the weight."""
        return *super().freedoms(), Freedom.LOG_WEIGHT

    def moved(self, step: Array) -> Self:
        """Returns the Gaussian changed by a step (5,) of an isotropic one, or (10,)."""
        weight = self.weight * float(np.exp(step[-1]))
        return super().moved(step[:-1]).model_copy(update={"weight": weight})


class IsotropicGaussianParameters(BallParameters, GaussianParameters):
    """A Gaussian of the same standard deviation in all directions."""
