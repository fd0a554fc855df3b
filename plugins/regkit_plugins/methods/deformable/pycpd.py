"""Deformable coherent point drift by pycpd."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from regkit.deformation import Displaced
from regkit.system.arrays import Array
from regkit.system.optional import load_library
from regkit_plugins.methods.deformable.coherent import INSTALL, CoherentPointDrift


class PyCPD(CoherentPointDrift):
    """Deformable coherent point drift by pycpd."""

    kind: Literal["pycpd"] = "pycpd"

    def library(self) -> Any:
        """Returns the module ``pycpd``."""
        return load_library("pycpd", install=INSTALL)

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
        )
        registration.register()
        weights, change = np.asarray(registration.W), float(registration.diff)
        return self.result(source, weights, int(registration.iteration), change)
