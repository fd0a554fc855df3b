"""Coherent point drift by biocpd."""

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


class BioCPD(RigidMethod):
    """Rigid coherent point drift by biocpd, with sparse responsibilities."""

    kind: Literal["biocpd"] = "biocpd"

    outliers: Annotated[float, Field(ge=0.0, lt=1.0)] = 0.0
    """Fraction of outliers; the default is the library's."""
    max_iterations: Iterations = 100
    """Maximum number of iterations; the default is the library's."""

    def library(self) -> Any:
        """Returns the module ``biocpd``."""
        return load_library("biocpd", install="pip install 'regkit[baselines]'")

    def aligned(self, source: Array, target: Array, start: Array, size: float) -> Aligned:
        """Aligns with ``RigidRegistration``, whose rotations multiply rows from the right."""
        normalization = Normalization.around(target, size)
        registration = self.library().RigidRegistration(
            X=normalization.normalized(target),
            Y=normalization.normalized(transformed(start, source)),
            scale=False,
            w=self.outliers,
            max_iterations=self.max_iterations,
        )
        _, (_, rotation, translation) = registration.register()
        step = normalization.transform(np.asarray(rotation).T, np.asarray(translation).reshape(3))
        converged = registration.iteration < self.max_iterations
        message = "the objective converged" if converged else "max_iterations reached"
        return Aligned(step @ start, converged, int(registration.iteration), message)
