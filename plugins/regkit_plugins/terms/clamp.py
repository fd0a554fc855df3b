"""Clamp: nothing is gained by explaining a point more than once."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from regkit.gaussians.overlap import SELF_OVERLAP, Overlap
from regkit.interfaces import Response, Scene, Term
from regkit.primitives import Gaussians, Placed, Primitives
from regkit.system.arrays import Array


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

    def bind(self, scene: Scene) -> BoundClamp:
        """Bind the term to a frame's data."""
        return BoundClamp(self, scene)


class BoundClamp(Overlap):
    """``weight * sum max(0, overlap - self-similarity)`` over the data."""

    def __init__(self, term: Clamp, scene: Scene) -> None:
        frozen = term.covariance == "frozen"
        super().__init__(scene.observation, scene.placed, smoothing=0.0, frozen=frozen)
        self._weight = term.weight

    def weigh(self, densities: Array, data_weights: Array) -> float:
        """Only points beyond their own overlap put forces on primitives."""
        excess = densities.sum(axis=0) - SELF_OVERLAP * data_weights
        # The derivative of the excess is against that of the energy of an overlap, which is minus.
        densities *= -self._weight * (excess > 0.0)
        return self._weight * float(np.maximum(excess, 0.0).sum())

    def __call__(self, placed: Placed[Gaussians], *, curvature: bool = False) -> Response:
        """The energy and its wrenches; its curvature is negative where it counts, and left out."""
        response = super().__call__(placed)
        blocks = np.zeros((len(placed), 6, 6)) if curvature else None
        return Response(response.energy, response.wrenches, blocks)
