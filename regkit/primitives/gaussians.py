"""Gaussians: whole ones, and those of which a camera sees the front."""

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
    R^T. (The paper writes C for the matrix in the exponent and calls it a covariance; there it is a
    precision.)
    """

    @classmethod
    def isotropic(cls, segments: Indices, centres: Array, deviations: Array) -> Self:
        """Gaussians that are as wide in all directions.

        Args:
            segments: The segment that carries each, (K,).
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
    """Gaussians of which a camera, where there is one, sees only the front."""
