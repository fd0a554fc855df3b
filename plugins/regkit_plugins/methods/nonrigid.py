"""The non-rigid method: a smooth deformation after another method's pose."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from regkit.config.quantities import Iterations, Tolerance
from regkit.deformation import Deformed, DeformingMethod, FieldPrior, Stage, fitted
from regkit.system.arrays import Array

Part = Annotated[float, Field(ge=1e-3, le=1e3)]


class Nonrigid(DeformingMethod):
    """Moves the body onto the data by a smooth displacement field, after it was posed.

    The field is an affine map and a Gaussian process, fitted as the posterior mean under the
    likelihood of a mixture of Gaussians at the body's points, coarse to fine. All lengths are parts
    of the body's extent, the root mean square distance of its points from their centre, so that
    units do not matter. The pose is that of the first method; the deformation is in the result.
    """

    kind: Literal["nonrigid"] = "nonrigid"

    lengths: Annotated[tuple[Part, ...], Field(min_length=1)] = (1.2, 0.6)
    """Distances over which displacements vary, for one fit after the other."""
    stiffness: Annotated[float, Field(ge=1e-3, le=1e9)] = 1000.0
    """Stiffness of the field against the data: inverse variance of a displacement. Higher values
    keep parts without data closer to their place."""
    affine: Annotated[float, Field(ge=1e-3, le=1e9)] = 3000.0
    """Stiffness of the affine map."""
    outliers: Annotated[float, Field(gt=0.0, lt=1.0)] = 0.1
    """Fraction of the data that belongs to nothing of the body."""
    sides: Annotated[float, Field(ge=0.0, le=100.0)] = 2.0
    """How much less likely a pair is whose normals are orthogonal, as a logarithm; 0 leaves normals
    out."""
    begin: Part = 0.3
    """Standard deviation of the pairs at the start."""
    centres: Annotated[int, Field(ge=10, le=2000)] = 150
    """Number of places at which the field is free."""
    max_iterations: Iterations = 20
    """Maximum number of steps of each fit."""
    tolerance: Tolerance = 1e-3
    """Change of the displacements that ends a fit."""

    @property
    def stages(self) -> tuple[Stage, ...]:
        """The fits: of an affine map, then of each length."""
        lengths = (None, *self.lengths)
        return tuple(Stage(length, self.max_iterations) for length in lengths)

    @property
    def field_prior(self) -> FieldPrior:
        """What is expected of the field."""
        return FieldPrior(self.stiffness, self.affine, self.outliers, self.sides, self.begin)

    def deformed(self, source: Array, target: Array) -> Deformed:
        """Fits the field."""
        fit = fitted(
            source,
            target,
            self.stages,
            self.field_prior,
            centres=self.centres,
            tolerance=self.tolerance,
        )
        message = "the displacements settled" if fit.converged else "the maximum number of steps"
        return Deformed(fit.field, fit.probability, fit.energy, fit.converged, fit.steps, message)
