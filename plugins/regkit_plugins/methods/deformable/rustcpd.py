"""Deformable coherent point drift by rustcpd."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from regkit.deformation import Displaced
from regkit.system.arrays import Array
from regkit_plugins.methods.deformable.coherent import CoherentPointDrift


class RustCPD(CoherentPointDrift):
    """Deformable coherent point drift by rustcpd, on one thread."""

    kind: Literal["rustcpd"] = "rustcpd"

    module: ClassVar[str] = "rustcpd"

    def displaced(self, source: Array, target: Array) -> Displaced:
        """Registers with ``register_deformable``."""
        found = self.library().register_deformable(
            target,
            source,
            alpha=self.stiffness,
            beta=self.width,
            outlier_weight=self.outliers,
            max_iterations=self.max_iterations,
            tolerance=self.tolerance,
            parallel=False,
        )
        weights = np.asarray(found.weights)
        return self.result(source, weights, int(found.iterations), float(found.difference))
