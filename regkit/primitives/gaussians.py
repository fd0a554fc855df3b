"""Gaussians, whole or seen from the front only."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from regkit.primitives.volumes import Volumes
from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class Gaussians(Volumes):
    """Un-normalised Gaussians, eqs. 1 and 3; the scales are standard deviations.

    ``G(x) = weight * exp(-1/2 (x - m)^T C^-1 (x - m))`` with the covariance C = R diag(scales^2)
    R^T. (The paper calls the matrix C in the exponent a covariance although it is a precision.)
    """

    @classmethod
    def isotropic(cls, segments: Indices, centres: Array, deviations: Array) -> Self:
        """Returns isotropic Gaussians of weight one.

        Args:
            segments: Segment of each Gaussian, (K,).
            centres: Means in the segments' frames, (K, 3) [m].
            deviations: Standard deviations, (K,) [m].
        """
        count = len(segments)
        return cls(
            segments=segments,
            centres=centres,
            axes=np.tile(np.eye(3), (count, 1, 1)),
            scales=np.repeat(deviations[:, None], 3, axis=1),
            weights=np.ones(count),
        )


@dataclass(frozen=True)
class SurfaceGaussians(Gaussians):
    """Gaussians whose visible side alone faces the data if the observation has a camera."""
