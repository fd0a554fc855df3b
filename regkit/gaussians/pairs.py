"""All pairs of K model Gaussians with N data points: two matrix products around one exponential.

With homogeneous coordinates h = (y, 1) and Z = [I, -m], so that Z h = y - m, the exponent of a pair
is the quadratic form -1/2 h^T (Z^T P Z) h, linear in the ten features of the data (y y^T, y, 1).
Gradient and Gauss-Newton blocks need only the moments sum w h h^T. A kernel derives the weights w
from the densities: the densities themselves (correlation) or posterior probabilities (likelihood).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.gaussians.compiled import stiffness_blocks
from regkit.system.arrays import Array


class Pairs:
    """Features of N data points that share one variance.

    Args:
        points: (N, 3) [m], centred near the origin: far from it the features cancel badly.
        weights: Positive weights of the points, (N,).
        count: Number K of model Gaussians.
    """

    def __init__(self, points: Array, weights: Array, count: int) -> None:
        x, y, z = points.T
        ones = np.ones(len(points))
        features = [x * x, y * y, z * z, x * y, x * z, y * z, x, y, z, ones]
        # Equal weights are a constant; others add one feature whose coefficient is one.
        self._log_weight = float(np.log(weights[0])) if np.ptp(weights) == 0.0 else 0.0
        if np.ptp(weights) > 0.0:
            features.append(np.log(weights))
        self._features = np.array(features)
        self._transposed = self._features[:10].T
        self._coefficients = np.ones((count, len(features)))
        self._kernel = np.empty((count, len(points)))
        self._floor = np.full(len(points), _FLOOR)
        self._relative = np.zeros((count, 3, 4))
        self._relative[:, :, :3] = np.eye(3)

    def densities(self, means: Array, precisions: Array, log_scales: Array) -> Array:
        """Returns ``weight * exp(log_scale - 1/2 (y - m)^T P (y - m))`` of every pair.

        Args:
            means: m, (K, 3) [m], in the frame of the points.
            precisions: P, (K, 3, 3) [1/m^2].
            log_scales: (K,).

        Returns:
            (K, N), in a buffer that the next call overwrites.
        """
        self._relative[:, :, 3] = -means
        turned = self._relative.transpose(0, 2, 1)
        quadric = (turned @ (precisions @ self._relative)).reshape(-1, 16)
        coefficients = self._coefficients
        coefficients[:, :10] = quadric @ _COEFFICIENTS
        coefficients[:, 9] += log_scales + self._log_weight
        np.matmul(coefficients, self._features, out=self._kernel)
        np.maximum(self._kernel, self._floor, out=self._kernel)
        np.exp(self._kernel, out=self._kernel)
        return self._kernel

    def moments(self, shares: Array, precisions: Array) -> Moments:
        """Returns the moments of the data about the means of the last ``densities``.

        Args:
            shares: Weights of the pairs, (K, N).
            precisions: P, (K, 3, 3) [1/m^2].
        """
        flat = shares @ self._transposed
        about = self._relative @ flat.take(_MATRIX, axis=1).reshape(-1, 4, 4)
        return Moments(flat[:, 9], about, self._relative, precisions)


@dataclass(frozen=True)
class Moments:
    """Weighted sums over the data of q = y - m, for each of K Gaussians.

    Attributes:
        mass: sum w, (K,).
        about: sum w q h^T, (K, 3, 4).
        relative: Z, (K, 3, 4), with q = Z h.
        precisions: P, inverse of the sum of model and data covariance, (K, 3, 3) [1/m^2].
    """

    mass: Array
    about: Array
    relative: Array
    precisions: Array

    def pulls(self) -> tuple[Array, Array]:
        """Returns sum w P q (K, 3) and sum w P q q^T (K, 3, 3)."""
        pulled = self.precisions @ self.about
        return pulled[:, :, 3], pulled @ self.relative.transpose(0, 2, 1)

    def stiffness(self, shift: Array) -> Array:
        """Returns the Gauss-Newton blocks (K, 6, 6): sum w J^T P J with J = [I, -[q]x].

        The data are isotropic, so the residual rotates with the segment, and its derivative to a
        motion of the segment is the velocity of the model's material at y.

        Args:
            shift: Vectors from the means to the centres of rotation, (K, 3) [m].
        """
        return stiffness_blocks(self.mass, self.about, self.relative, self.precisions, shift)


_FLOOR = -600.0
"""Lower bound of exponents. Such a density is negligible (1e-261), while numbers near underflow
slow the processor up to a hundredfold."""

_MATRIX = np.array([0, 3, 4, 6, 3, 1, 5, 7, 4, 5, 2, 8, 6, 7, 8, 9])
"""Indices of the ten moments in the flattened matrix sum w h h^T."""

_COEFFICIENTS = np.zeros((16, 10))
_COEFFICIENTS[np.arange(16), _MATRIX] = -0.5
"""Maps a flattened matrix Q (16,) to the coefficients of the ten features in -1/2 h^T Q h."""
