"""Deformable coherent point drift by biocpd."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Literal

import numpy as np

from regkit_plugins.methods.deformable.coherent import DeformableRegistration


class BioCPDDeformable(DeformableRegistration):
    """Deformable coherent point drift by biocpd."""

    kind: Literal["biocpd_deformable"] = "biocpd_deformable"

    module: ClassVar[str] = "biocpd"
    # The library's default of the second is drawn at random from NumPy's global generator.
    arguments: ClassVar[Mapping[str, Any]] = {
        "dtype": np.float64,
        "low_rank_method": "pivoted_cholesky",
    }
