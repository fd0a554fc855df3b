"""Coherent point drift and FilterReg by probreg."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from regkit.alignment.normalization import Normalization
from regkit.alignment.rigid_method import Aligned, RigidMethod
from regkit.config.quantities import Iterations
from regkit.geometry.rigid import transformed
from regkit.system.arrays import Array
from regkit.system.optional import load_library

INSTALL = "pip install --no-deps probreg && pip install six transforms3d scikit-learn pyyaml addict"
"""probreg requires one old version of Open3D, but works with newer ones."""


class ProbregCPD(RigidMethod):
    """Coherent point drift by probreg, with time and memory for all pairs."""

    kind: Literal["probreg_cpd"] = "probreg_cpd"

    outliers: Annotated[float, Field(ge=0.0, lt=1.0)] = 0.0
    """Fraction of outliers; the default is the library's."""
    max_iterations: Iterations = 50
    """Maximum number of iterations; the default is the library's."""

    def library(self) -> Any:
        """Returns the module ``probreg.cpd``."""
        return load_library("probreg.cpd", install=INSTALL)

    def aligned(self, source: Array, target: Array, start: Array, size: float) -> Aligned:
        """Aligns with ``registration_cpd``."""
        normalization = Normalization.around(target, size)
        result = self.library().registration_cpd(
            normalization.normalized(transformed(start, source)),
            normalization.normalized(target),
            "rigid",
            w=self.outliers,
            maxiter=self.max_iterations,
            update_scale=False,
        )
        return _aligned(result.transformation, normalization, start)


class ProbregFilterReg(RigidMethod):
    """FilterReg by probreg, point to point."""

    kind: Literal["probreg_filterreg"] = "probreg_filterreg"

    outliers: Annotated[float, Field(ge=0.0, lt=1.0)] = 0.0
    """Fraction of outliers; the default is the library's."""
    shrinking: bool = False
    """Whether the Gaussians become narrower at each iteration; the default is the library's."""
    max_iterations: Iterations = 50
    """Maximum number of iterations; the default is the library's."""

    def library(self) -> Any:
        """Returns the module ``probreg.filterreg``."""
        return load_library("probreg.filterreg", install=INSTALL)

    def aligned(self, source: Array, target: Array, start: Array, size: float) -> Aligned:
        """Aligns with ``registration_filterreg``."""
        normalization = Normalization.around(target, size)
        result = self.library().registration_filterreg(
            normalization.normalized(transformed(start, source)),
            normalization.normalized(target),
            update_sigma2=self.shrinking,
            w=self.outliers,
            maxiter=self.max_iterations,
        )
        return _aligned(result.transformation, normalization, start)


def _aligned(transformation: Any, normalization: Normalization, start: Array) -> Aligned:
    step = normalization.transform(np.asarray(transformation.rot), np.asarray(transformation.t))
    return Aligned(step @ start, True, 0, "the library does not report convergence")
