"""Features of a Gaussian process: a low-rank basis of smooth functions in space."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.system.arrays import Array, Indices

SMALLEST = 1e-4
"""A direction of the basis with less variance, relative to the largest, is left out."""


@dataclass(frozen=True)
class Features:
    """A basis of D functions whose independent standard normal weights make a Gaussian process.

    The process has the covariance ``exp(-|x - y|^2 / (2 l^2))``, approximated from K centres.
    Source: Williams and Seeger, Using the Nystroem method to speed up kernel machines, NIPS 2000.

    Attributes:
        centres: Centres, (K, 3).
        length: Length l over which the functions vary.
        weights: Weights of the centres in each function, (K, D).
    """

    centres: Array
    length: float
    weights: Array

    @classmethod
    def of(cls, centres: Array, length: float) -> Features:
        """Returns the basis of some centres (K, 3) and a length."""
        variances, directions = np.linalg.eigh(_covariance(centres, centres, length))
        kept = variances > SMALLEST * variances[-1]
        return cls(centres, length, directions[:, kept] / np.sqrt(variances[kept]))

    def at(self, points: Array) -> Array:
        """Returns the values of the functions at points (N, 3), (N, D)."""
        return np.asarray(_covariance(points, self.centres, self.length) @ self.weights)


def spread(points: Array, count: int) -> Indices:
    """Returns the indices (K,) of points (N, 3) that are far apart, by farthest-point sampling."""
    chosen = [int(((points - points.mean(axis=0)) ** 2).sum(axis=1).argmax())]
    distances = ((points - points[chosen[0]]) ** 2).sum(axis=1)
    while len(chosen) < min(count, len(points)):
        chosen.append(int(distances.argmax()))
        distances = np.minimum(distances, ((points - points[chosen[-1]]) ** 2).sum(axis=1))
    return np.array(chosen)


def _covariance(points: Array, others: Array, length: float) -> Array:
    squares = (points**2).sum(axis=1)[:, None] + (others**2).sum(axis=1) - 2.0 * points @ others.T
    return np.asarray(np.exp(-0.5 / length**2 * np.maximum(squares, 0.0)))
