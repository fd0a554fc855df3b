"""Smooth deformations: displacement fields of Gaussian processes, fitted to two clouds.

``DisplacementField`` is the field, ``Features`` its basis; ``fitted`` fits one to two clouds.
"""

from regkit.deformation.features import Features
from regkit.deformation.field import DisplacementField
from regkit.deformation.fitting import Fit, Stage, fitted
from regkit.deformation.mixture import FieldPrior

__all__ = ["DisplacementField", "Features", "FieldPrior", "Fit", "Stage", "fitted"]
