"""Overlap of model and data Gaussians: the paper's similarity, eq. 8."""

from __future__ import annotations

import numpy as np

from regkit.gaussians.similarity import GaussianSimilarity
from regkit.observation import Observation
from regkit.primitives import Gaussians, Placed
from regkit.system.arrays import Array

SELF_OVERLAP = 2.0**-1.5
"""Overlap of an isotropic Gaussian with itself, divided by its integral."""


class Overlap(GaussianSimilarity):
    """The negative of eq. 8 in closed form, summed over all pairs.

    With q = y_j - m_i and S = C_i + (sigma_j^2 + smoothing^2) I it reads

        E_ij = (2 pi)^(3/2) sqrt(|C_i| sigma_j^6 / |S|) exp(-1/2 q^T S^-1 q).

    Args:
        observation: Points, weights and variances of the data.
        start: Primitives in the start pose.
        smoothing: Standard deviation of the Gaussian that smooths the data [m].
        frozen: Whether covariances keep their orientation of the start pose.
    """

    volume_power = 1.0

    def __init__(
        self,
        observation: Observation,
        start: Placed[Gaussians],
        *,
        smoothing: float,
        frozen: bool,
    ) -> None:
        # The integrals of the data's Gaussians without the common factor (2 pi)^(3/2).
        masses = observation.weights * observation.variances**1.5
        super().__init__(
            observation,
            start,
            data_weights=masses / masses.sum(),
            log_weights=np.log(start.primitives.weights),
            smoothing=smoothing,
            frozen=frozen,
        )

    def weigh(self, densities: Array, data_weights: Array) -> float | None:
        """Leaves the densities as weights: exp is its own derivative."""
        return None

    def inliers(self, densities: Array, data_weights: Array) -> Array:
        """Returns each point's overlap with the primitives as a fraction of its self-overlap."""
        overlap = densities.sum(axis=0) / data_weights
        return np.asarray(np.minimum(overlap / SELF_OVERLAP, 1.0))
