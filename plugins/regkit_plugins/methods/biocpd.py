"""Coherent point drift, as biocpd has it."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from regkit.alignment.rigid_method import Aligned, Normalization, RigidMethod
from regkit.geometry.rigid import transformed
from regkit.system.arrays import Array
from regkit.system.optional import load_library


class BioCPD(RigidMethod):
    """biocpd's rigid coherent point drift, with sparse responsibilities."""

    kind: Literal["biocpd"] = "biocpd"

    outliers: Annotated[float, Field(ge=0.0, lt=1.0)] = 0.0
    """Share of outliers; the library's own default."""
    max_iterations: Annotated[int, Field(ge=1)] = 100
    """Steps at most; the library's own default."""

    def library(self) -> Any:
        """Returns the module ``biocpd``."""
        return load_library("biocpd", install="pip install 'regkit[baselines]'")

    def aligned(self, source: Array, target: Array, start: Array, size: float) -> Aligned:
        """Align by ``RigidRegistration``, whose rotations stand to the right of points in rows."""
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
