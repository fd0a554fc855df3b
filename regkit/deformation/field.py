"""Displacement fields: an affine part and a Gaussian process."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from regkit.deformation.features import Features
from regkit.interfaces import Deformation
from regkit.system.arrays import Array

BLOCK = 20_000
"""Number of points that are moved at once, which bounds the memory."""


@dataclass(frozen=True)
class DisplacementField(Deformation):
    """``x + scale * (A u + t + F(u) W)`` with ``u = (x - centre) / scale``.

    Attributes:
        centre: Centre of the body, (3,) [m].
        scale: Its extent [m]; everything else is in units of it.
        features: The basis F of a Gaussian process; None for an affine field.
        coefficients: Weights of the features W, the translation t and the rows of A^T, (D + 4, 3).
    """

    centre: Array
    scale: float
    features: Features | None
    coefficients: Array

    def moved(self, points: Array) -> Array:
        """Returns where points (N, 3) [m] go."""
        parts = np.array_split(points, max(1, len(points) // BLOCK))
        return np.concatenate([part + self.displacements(part) for part in parts])

    def displacements(self, points: Array) -> Array:
        """Returns the displacements (N, 3) [m] of points (N, 3) [m]."""
        basis = basis_at((points - self.centre) / self.scale, self.features)
        return np.asarray(self.scale * (basis @ self.coefficients))

    def shifted(self, origin: Array) -> Self:
        """Returns the same field in a world whose origin is at ``-origin`` (3,) [m]."""
        return replace(self, centre=self.centre + origin)


def basis_at(points: Array, features: Features | None) -> Array:
    """Returns the features, ones and the coordinates of points (N, 3), (N, D + 4)."""
    smooth = np.zeros((len(points), 0)) if features is None else features.at(points)
    return np.hstack([smooth, np.ones((len(points), 1)), points])
