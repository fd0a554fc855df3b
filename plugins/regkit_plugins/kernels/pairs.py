"""All pairs of K model Gaussians with N data points: two matrix products around one exponential.

With homogeneous coordinates h = (y, 1) and Z = [I, -m], so that Z h = y - m, the exponent of a pair
is the quadratic form -1/2 h^T (Z^T P Z) h, linear in the ten features of the data (y y^T, y, 1).
What a Gaussian needs back are the moments sum w h h^T, for whatever weights w a kernel makes of the
densities: the densities themselves (correlation) or their shares of a point (likelihood).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.arrays import Array
from regkit.rotation import skew


class Pairs:
    """The data side, for points of one variance.

    Args:
        points: (N, 3) [m], near the origin: far from it the features cancel badly.
        weights: Of the points, (N,), positive.
        count: Number K of model Gaussians.
    """

    def __init__(self, points: Array, weights: Array, count: int) -> None:
        x, y, z = points.T
        ones = np.ones(len(points))
        features = [x * x, y * y, z * z, x * y, x * z, y * z, x, y, z, ones, np.log(weights)]
        self._features = np.array(features)
        self._transposed = self._features[:10].T
        self._coefficients = np.ones((count, 11))
        self._kernel = np.empty((count, len(points)))
        self._floor = np.full(len(points), _FLOOR)
        self._relative = np.zeros((count, 3, 4))
        self._relative[:, :, :3] = np.eye(3)

    def densities(self, means: Array, precisions: Array, log_scales: Array) -> Array:
        """Of every pair, the point's weight times exp(log_scale - 1/2 (y - m)^T P (y - m)).

        Returns:
            (K, N), in a buffer that the next call uses again.
        """
        self._relative[:, :, 3] = -means
        turned = self._relative.transpose(0, 2, 1)
        quadric = (turned @ (precisions @ self._relative)).reshape(-1, 16)
        coefficients = self._coefficients
        np.multiply(quadric.take(_ENTRIES, axis=1), _FACTORS, out=coefficients[:, :10])
        coefficients[:, 9] += log_scales
        np.matmul(coefficients, self._features, out=self._kernel)
        np.maximum(self._kernel, self._floor, out=self._kernel)
        np.exp(self._kernel, out=self._kernel)
        return self._kernel

    def moments(self, shares: Array, precisions: Array) -> Moments:
        """The moments of the data about the means of ``densities``, under weights (K, N)."""
        flat = shares @ self._transposed
        about = self._relative @ flat.take(_MATRIX, axis=1).reshape(-1, 4, 4)  # sum w q h^T
        second = about @ self._relative.transpose(0, 2, 1)
        return Moments(flat[:, 9], about[:, :, 3], second, precisions)


@dataclass(frozen=True)
class Moments:
    """Weighted sums over the data of q = y - m, for each of K Gaussians.

    Attributes:
        mass: sum w, (K,).
        first: sum w q, (K, 3) [m].
        second: sum w q q^T, (K, 3, 3) [m^2].
        precisions: P, (K, 3, 3), the inverse of model and data covariance together.
    """

    mass: Array
    first: Array
    second: Array
    precisions: Array

    def forces(self) -> Array:
        """The derivative of 1/2 sum w q^T P q to the means, (K, 3)."""
        return -(self.precisions @ self.first[:, :, None])[:, :, 0]

    def spreads(self) -> Array:
        """Its derivative to the covariance P^-1, (K, 3, 3)."""
        return -0.5 * self.precisions @ self.second @ self.precisions

    def about(self, shift: Array) -> Moments:
        """The same sums about other points, the means plus ``shift`` (K, 3)."""
        mass = self.mass[:, None]
        first = self.first - mass * shift
        mixed = (self.first - 0.5 * mass * shift)[:, :, None] * shift[:, None, :]
        second = self.second - mixed - mixed.transpose(0, 2, 1)
        return Moments(self.mass, first, second, self.precisions)

    def stiffness(self) -> Array:
        """The Gauss-Newton blocks (K, 6, 6): sum w J^T P J with J = [I, -[q]x].

        The residual turns with the segment, since the data are isotropic; so its derivative to a
        motion of the segment is that of the model's material at y.
        """
        blocks = np.empty((len(self.mass), 6, 6))
        mixed = -self.precisions @ skew(self.first)
        blocks[:, :3, :3] = self.mass[:, None, None] * self.precisions
        blocks[:, :3, 3:] = mixed
        blocks[:, 3:, :3] = mixed.transpose(0, 2, 1)
        turned = np.einsum("nij,ljb->nilb", self.precisions, _UNIT_SKEWS)
        blocks[:, 3:, 3:] = np.einsum("kia,nilb,nkl->nab", _UNIT_SKEWS, turned, self.second)
        return blocks


def axial(matrices: Array) -> Array:
    """The vectors (K, 3) with the components M_yz - M_zy, M_zx - M_xz, M_xy - M_yx."""
    flat = matrices.reshape(-1, 9)
    return np.asarray(flat.take(_AFTER, axis=1) - flat.take(_BEFORE, axis=1))


_FLOOR = -600.0
"""Exponents below this are raised to it: such a density is nothing (1e-261), but numbers near
underflow take the processor up to a hundred times as long."""

_ENTRIES = np.array([0, 5, 10, 1, 2, 6, 3, 7, 11, 15])
"""Where a flattened symmetric 4x4 matrix has its ten entries, in the order of the features."""

_FACTORS = np.array([-0.5, -0.5, -0.5, -1.0, -1.0, -1.0, -1.0, -1.0, -1.0, -0.5])
"""Factors of those entries in the exponent -1/2 h^T Q h."""

_MATRIX = np.array([0, 3, 4, 6, 3, 1, 5, 7, 4, 5, 2, 8, 6, 7, 8, 9])
"""Where the ten moments stand in the flattened matrix sum w h h^T."""

_AFTER, _BEFORE = np.array([5, 6, 1]), np.array([7, 2, 3])
"""Entries of a flattened matrix whose differences are its axial vector."""

_UNIT_SKEWS = skew(np.eye(3))
"""[e_k]x for the three unit vectors, (3, 3, 3)."""
