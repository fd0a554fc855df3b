"""The paper's similarity: the overlap of the template's Gaussians with those of the data."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from regkit.gaussians.similarity import GaussianSimilarity
from regkit.interfaces import Kernel
from regkit.observation import Observation
from regkit.primitives import Gaussians, Placed, Primitives
from regkit.system.arrays import Array


class Correlation(Kernel):
    """Spatial correlation of a sum of Gaussians, generalized or not, with that of the data.

    The energy is minus the paper's E (eq. 5) divided by the integral of the data's Gaussians, that
    is, minus the mean density of the template over the data: a number without a unit, whose size
    does not depend on how many points there are.
    """

    kind: Literal["correlation"] = "correlation"
    accepts: ClassVar[type[Primitives]] = Gaussians

    covariance: Literal["exact", "frozen"] = "exact"
    """Whether covariances turn with their segments, or keep their orientation of the start pose, as
    the paper has it (after eq. 11)."""

    def bind(
        self, observation: Observation, start: Placed[Gaussians], *, smoothing: float = 0.0
    ) -> BoundCorrelation:
        """Bind the kernel to a frame's data."""
        return BoundCorrelation(self, observation, start, smoothing)


class BoundCorrelation(GaussianSimilarity):
    """Eq. 8 in closed form.

    With q = y_j - m_i and S = C_i + (sigma_j^2 + smoothing^2) I it reads

        E_ij = (2 pi)^(3/2) sqrt(|C_i| sigma_j^6 / |S|) exp(-1/2 q^T S^-1 q).
    """

    volume_power = 1.0

    def __init__(
        self,
        kernel: Correlation,
        observation: Observation,
        start: Placed[Gaussians],
        smoothing: float,
    ) -> None:
        # The integrals of the data's Gaussians but for (2 pi)^(3/2).
        masses = observation.weights * observation.variances**1.5
        super().__init__(
            observation,
            start,
            data_weights=masses / masses.sum(),
            log_weights=np.log(start.primitives.weights),
            smoothing=smoothing,
            frozen=kernel.covariance == "frozen",
        )

    def weigh(self, densities: Array, data_weights: Array) -> float | None:
        """A pair weighs as much as it overlaps, for the derivative of exp is exp."""
        return None

    def inliers(self, densities: Array, data_weights: Array) -> Array:
        """Each point's overlap with the primitives, as a part of that with itself."""
        overlap = densities.sum(axis=0) / data_weights
        return np.asarray(np.minimum(overlap / SELF_SIMILARITY, 1.0))


SELF_SIMILARITY = 2.0**-1.5
"""The overlap of an isotropic Gaussian with itself, over its integral."""
