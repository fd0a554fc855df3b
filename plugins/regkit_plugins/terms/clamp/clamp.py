"""Clamp: limits the overlap that each data point contributes."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from regkit.body import Body
from regkit.config.quantities import Weight
from regkit.gaussians.compiled_similarity import COLUMNS, shows_surface
from regkit.gaussians.overlap import SELF_OVERLAP, Overlap
from regkit.interfaces import CompiledEnergy, Response, Scene, Term
from regkit.primitives import Gaussians, Placed, Primitives
from regkit.system.arrays import Array
from regkit_plugins.terms.clamp.compiled import bind, respond


class Clamp(Term):
    """Penalises the overlap with a data Gaussian beyond the data Gaussian's self-overlap.

    With the kernel ``correlation`` it clamps each point's overlap to the self-overlap, as in the
    SoG trackers before the paper. With other kernels it keeps primitives from concentrating on the
    same data.
    """

    kind: Literal["clamp"] = "clamp"
    accepts: ClassVar[type[Primitives]] = Gaussians

    weight: Weight = 1.0
    """Weight relative to the kernel's energy."""
    covariance: Literal["exact", "frozen"] = "exact"
    """Whether covariances rotate with their segments; use the value of the kernel."""

    def bind(self, scene: Scene) -> BoundClamp:
        """Binds the term to the data of a frame."""
        return BoundClamp(self, scene)

    def compiled(self, body: Body, primitives: Primitives) -> CompiledEnergy | None:
        """Returns the term as compiled functions, for Gaussians."""
        surface = shows_surface(primitives)
        if surface is None:
            return None
        numbers = (surface, self.covariance == "frozen", self.weight)
        return CompiledEnergy(respond, numbers, bind=bind, state=(len(primitives), COLUMNS))


class BoundClamp(Overlap):
    """``weight * sum max(0, overlap - self-overlap)`` over the data."""

    def __init__(self, term: Clamp, scene: Scene) -> None:
        frozen = term.covariance == "frozen"
        super().__init__(scene.observation, scene.placed, smoothing=0.0, frozen=frozen)
        self._weight = term.weight

    def weigh(self, densities: Array, data_weights: Array) -> float:
        """Returns the energy; only points whose overlap exceeds their self-overlap exert forces."""
        excess = densities.sum(axis=0) - SELF_OVERLAP * data_weights
        # The energy of an overlap is negative, so the derivative of the excess has a minus sign.
        densities *= -self._weight * (excess > 0.0)
        return self._weight * float(np.maximum(excess, 0.0).sum())

    def __call__(self, placed: Placed[Gaussians], *, curvature: bool = False) -> Response:
        """Returns energy and wrenches; the curvature is not positive, so the blocks are zero."""
        response = super().__call__(placed)
        blocks = np.zeros((len(placed), 6, 6)) if curvature else None
        return Response(response.energy, response.wrenches, blocks)
