"""The mixture of a moved source, from which a target is drawn: expectation maximisation.

The points of the source are the means of isotropic Gaussians of one variance, and those of the
target are drawn from them, or are outliers. Normals tell the sides of a thin part apart.

Sources: Myronenko and Song, Point set registration: coherent point drift, PAMI 32, 2010; Hirose, A
Bayesian formulation of coherent point drift, PAMI 43, 2021.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from regkit.clouds import normals, spacing
from regkit.system.arrays import Array

NEIGHBOURS = 16
"""Number of neighbours from which a normal is estimated."""

FINEST = 0.5
"""Least standard deviation of the Gaussians, in units of the target's spacing."""


@dataclass(frozen=True)
class FieldPrior:
    """What is expected of a field, in units of the source's extent.

    Attributes:
        stiffness: Inverse variance of a displacement.
        affine: Inverse variance of the affine part's entries.
        outliers: Fraction of the target that is drawn from no point of the source.
        sides: How much less likely a pair is with orthogonal normals, as a logarithm.
        begin: Standard deviation of the Gaussians at the start.
    """

    stiffness: float
    affine: float
    outliers: float
    sides: float
    begin: float


@dataclass
class Mixture:
    """The mixture, with all lengths in units of the source's extent; pairs in single precision.

    Attributes:
        source: The source, (M, 3).
        target: The target, (N, 3).
        prior: What is expected of the field.
        volume: Volume in which outliers are evenly spread.
        finest: Least variance.
        facing: Normals of the target of arbitrary sign, (N, 3).
        moved: The moved source, (M, 3).
        variance: Variance of the Gaussians.
        turned: Normals of the moved source, (M, 3).
    """

    source: Array
    target: Array
    prior: FieldPrior
    volume: float
    finest: float
    facing: Array
    moved: Array
    variance: float
    turned: Array

    @classmethod
    def of(cls, source: Array, target: Array, prior: FieldPrior) -> Mixture:
        """Returns the mixture of an aligned source and a target.

        Args:
            source: The source, (M, 3).
            target: The target, (N, 3).
            prior: What is expected of the field.
        """
        both = np.concatenate([source, target])
        facing = normals(target, NEIGHBOURS)
        return cls(
            source=source,
            target=target,
            prior=prior,
            volume=float(np.prod(np.ptp(both, axis=0).clip(1e-3))),
            finest=(FINEST * spacing(target)) ** 2,
            facing=facing,
            moved=source.copy(),
            variance=prior.begin**2,
            turned=np.zeros_like(source),
        )

    def renew_normals(self) -> None:
        """Estimates the normals of the moved source."""
        self.turned = normals(self.moved, NEIGHBOURS)

    def improved(self, basis: Array, stiffness: Array) -> tuple[Array, float]:
        """Takes a step: the probabilities of all pairs, the field, and the variance.

        Args:
            basis: Basis of the field at the source, (M, D).
            stiffness: Inverse variances of its coefficients, (D,).

        Returns:
            The coefficients (D, 3), and the root mean square change of the displacements.
        """
        pairs = self._pairs()
        own = pairs.sum(axis=1).astype(np.float64)
        drawn = (pairs @ self.target.astype(np.float32)).astype(np.float64)
        matrix = basis.T @ (own[:, None] * basis) / self.variance + np.diag(stiffness)
        pull = basis.T @ (drawn - own[:, None] * self.source) / self.variance
        coefficients = np.linalg.solve(matrix, pull)
        before, self.moved = self.moved, self.source + basis @ coefficients
        of_target = pairs.sum(axis=0).astype(np.float64)
        squares = (
            of_target @ (self.target**2).sum(axis=1)
            - 2.0 * (drawn * self.moved).sum()
            + own @ (self.moved**2).sum(axis=1)
        )
        self.variance = max(float(squares / (3.0 * own.sum())), self.finest)
        change = float(np.sqrt(((self.moved - before) ** 2).sum(axis=1).mean()))
        return coefficients, change

    def explained(self) -> tuple[Array, float]:
        """Returns the probability (N,) that a target point is no outlier, and the energy."""
        pairs = self._pairs()
        inlier = pairs.sum(axis=0).astype(np.float64)
        # The density of a point is that of outliers, divided by the probability of being one.
        density = self.prior.outliers / self.volume / np.maximum(1.0 - inlier, 1e-12)
        return inlier, float(-np.log(density).mean())

    def _pairs(self) -> NDArray[np.float32]:
        """Returns the probability (M, N) that a target point is drawn from a source point."""
        moved, target = self.moved.astype(np.float32), self.target.astype(np.float32)
        pairs = moved @ target.T
        pairs -= 0.5 * (moved**2).sum(axis=1)[:, None]
        pairs -= 0.5 * (target**2).sum(axis=1)
        pairs /= np.float32(self.variance)
        if self.prior.sides > 0.0:
            cosines = self.turned.astype(np.float32) @ self.facing.T.astype(np.float32)
            cosines *= cosines
            cosines -= 1.0
            cosines *= np.float32(self.prior.sides)
            pairs += cosines
        np.exp(pairs, out=pairs)
        share = self.prior.outliers
        outlier = (2.0 * np.pi * self.variance) ** 1.5 * share / (1.0 - share)
        outlier *= len(self.source) / self.volume
        pairs /= pairs.sum(axis=0) + np.float32(outlier)
        return np.asarray(pairs, dtype=np.float32)
