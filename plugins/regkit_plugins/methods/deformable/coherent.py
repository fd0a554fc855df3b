"""What the libraries of deformable coherent point drift have in common."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar

import numpy as np
from pydantic import Field

from regkit.config.quantities import Iterations, Tolerance
from regkit.deformation import Displaced, KernelDisplacements, LibraryDeformation
from regkit.system.arrays import Array
from regkit.system.optional import load_library


class CoherentPointDrift(LibraryDeformation):
    """Deformable coherent point drift; all defaults are those of the library."""

    module: ClassVar[str]
    """The library's module."""

    outliers: Annotated[float, Field(ge=0.0, lt=1.0)] = 0.0
    """Fraction of outliers."""
    stiffness: Annotated[float, Field(gt=0.0, le=1e9)] = 2.0
    """Weight of the smoothness of the displacements (alpha)."""
    width: Annotated[float, Field(ge=1e-3, le=1e3)] = 2.0
    """Distance over which displacements vary, relative to the body's extent (beta)."""
    max_iterations: Iterations = 100
    """Maximum number of iterations."""
    tolerance: Tolerance = 1e-3
    """Change of the variance that ends the iterations, in squares of the body's extent."""

    def library(self) -> Any:
        """Returns the library's module."""
        return load_library(self.module, install="pip install 'regkit[baselines]'")

    def result(self, source: Array, weights: Array, iterations: int, change: float) -> Displaced:
        """Returns the result of a library.

        Args:
            source: Centres of the kernel, (M, 3).
            weights: Its weights, (M, 3).
            iterations: Number of iterations.
            change: Last change of the variance.
        """
        moving = KernelDisplacements(source, weights, self.width)
        converged = change <= self.tolerance
        message = "the variance converged" if converged else "max_iterations reached"
        return Displaced(moving, converged, iterations, message)


class DeformableRegistration(CoherentPointDrift):
    """A library that registers with an object ``DeformableRegistration``."""

    arguments: ClassVar[Mapping[str, Any]] = {}
    """Further arguments of the object."""

    def displaced(self, source: Array, target: Array) -> Displaced:
        """Registers with ``DeformableRegistration``."""
        registration = self.library().DeformableRegistration(
            X=target,
            Y=source,
            alpha=self.stiffness,
            beta=self.width,
            w=self.outliers,
            max_iterations=self.max_iterations,
            tolerance=self.tolerance,
            **self.arguments,
        )
        registration.register()
        weights, change = np.asarray(registration.W), float(registration.diff)
        return self.result(source, weights, int(registration.iteration), change)
