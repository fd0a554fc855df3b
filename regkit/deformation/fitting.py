"""Fitting of a displacement field to two clouds, from coarse to fine.

An affine field of little freedom comes first, because it takes up what a smooth one would distort.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from regkit.deformation.features import Features, spread
from regkit.deformation.field import DisplacementField, basis_at
from regkit.deformation.mixture import FieldPrior, Mixture
from regkit.system.arrays import Array

RENEWED = 5
"""Number of steps between estimates of the moved source's normals."""


@dataclass(frozen=True)
class Stage:
    """One stage of the fit, from coarse to fine.

    Attributes:
        length: Length of the Gaussian process, in units of the source's extent; None for an affine
            field.
        steps: Largest number of steps.
    """

    length: float | None
    steps: int


@dataclass(frozen=True)
class Fit:
    """A fitted field.

    Attributes:
        field: The field.
        sigma: Standard deviation of the Gaussians at the end [m].
        probability: Probability of each target point that it belongs to the source, (N,).
        energy: Mean negative logarithm of the target's density, in units of the source's extent.
        steps: Number of steps.
        converged: Whether the last stage ended by itself.
    """

    field: DisplacementField
    sigma: float
    probability: Array
    energy: float
    steps: int
    converged: bool


def fitted(
    source: Array,
    target: Array,
    stages: Sequence[Stage],
    prior: FieldPrior,
    *,
    centres: int,
    tolerance: float,
) -> Fit:
    """Returns the field that moves a source onto a target.

    Args:
        source: Points, (M, 3) [m], aligned with the target.
        target: Points, (N, 3) [m].
        stages: The stages, at least one.
        prior: What is expected of the field.
        centres: Number of centres of the Gaussian process.
        tolerance: Root mean square change of the displacements that ends a stage, in units of the
            source's extent.
    """
    centre = source.mean(axis=0)
    scale = float(np.sqrt(((source - centre) ** 2).sum(axis=1).mean()))
    mixture = Mixture.of((source - centre) / scale, (target - centre) / scale, prior)
    chosen = mixture.source[spread(mixture.source, centres)]
    steps, converged = 0, False
    for stage in stages:
        features = None if stage.length is None else Features.of(chosen, stage.length)
        basis = basis_at(mixture.source, features)
        stiffness = np.full(basis.shape[1], prior.stiffness)
        stiffness[-4:] = [0.0, *[prior.affine] * 3]
        for step in range(stage.steps):
            if step % RENEWED == 0:
                mixture.renew_normals()
            coefficients, change = mixture.improved(basis, stiffness)
            steps, converged = steps + 1, change < tolerance
            if converged:
                break
    probability, energy = mixture.explained()
    field = DisplacementField(centre, scale, features, coefficients)
    sigma = scale * float(np.sqrt(mixture.variance))
    return Fit(field, sigma, probability, energy, steps, converged)
