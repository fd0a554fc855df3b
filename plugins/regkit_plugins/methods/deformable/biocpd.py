"""Deformable coherent point drift by biocpd."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from regkit.deformation import Displaced
from regkit.system.arrays import Array
from regkit.system.optional import load_library
from regkit_plugins.methods.deformable.coherent import INSTALL, CoherentPointDrift


class BioCPDDeformable(CoherentPointDrift):
    """Deformable coherent point drift by biocpd."""

    kind: Literal["biocpd_deformable"] = "biocpd_deformable"

    def library(self) -> Any:
        """Returns the module ``biocpd``."""
        return load_library("biocpd", install=INSTALL)

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
            dtype=np.float64,
            # The library's default is drawn at random from NumPy's global generator.
            low_rank_method="pivoted_cholesky",
        )
        registration.register()
        weights, change = np.asarray(registration.W), float(registration.diff)
        return self.result(source, weights, int(registration.iteration), change)
