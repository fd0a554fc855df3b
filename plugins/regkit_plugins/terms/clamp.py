"""Clamp: nothing is gained by explaining a point more than once."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from regkit.interfaces import Response, Scene, Term
from regkit.primitives import Gaussians, Placed, Primitives
from regkit.system.arrays import Array
from regkit_plugins.kernels.correlation import SELF_SIMILARITY, BoundCorrelation, Correlation


class Clamp(Term):
    """Charges the overlap with a data Gaussian beyond that with itself.

    With the kernel ``correlation`` it makes of each point's overlap the smaller of the two, as in
    the trackers with sums of Gaussians before the paper; with other kernels it keeps primitives
    from being heaped on the same data.
    """

    kind: Literal["clamp"] = "clamp"
    accepts: ClassVar[type[Primitives]] = Gaussians

    weight: Annotated[float, Field(gt=0.0)] = 1.0
    """Weight against the kernel's energy."""
    covariance: Literal["exact", "frozen"] = "exact"
    """Whether covariances turn with their segments; the same as the kernel's."""

    def bind(self, scene: Scene) -> Excess:
        """Bind the term to a frame's data."""
        return Excess(self, scene)


class Excess(BoundCorrelation):
    """``weight * sum max(0, overlap - self-similarity)`` over the data."""

    def __init__(self, term: Clamp, scene: Scene) -> None:
        kernel = Correlation(covariance=term.covariance)
        super().__init__(kernel, scene.observation, scene.placed, 0.0)
        self._weight = term.weight

    def weigh(self, densities: Array, data_weights: Array) -> float:
        """Only points that are explained more than once put forces on primitives."""
        excess = densities.sum(axis=0) - SELF_SIMILARITY * data_weights
        # The derivative of the excess is against that of the energy of an overlap, which is minus.
        densities *= -self._weight * (excess > 0.0)
        return self._weight * float(np.maximum(excess, 0.0).sum())

    def __call__(self, placed: Placed[Gaussians], *, curvature: bool = False) -> Response:
        """The energy and its wrenches; its curvature is negative where it counts, and left out."""
        response = super().__call__(placed)
        blocks = np.zeros((len(placed), 6, 6)) if curvature else None
        return Response(response.energy, response.wrenches, blocks)
