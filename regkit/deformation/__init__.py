"""Smooth deformations: displacement fields of Gaussian processes, fitted to two clouds.

``DisplacementField`` is the field, ``Features`` its basis; ``fitted`` fits one to two clouds. A
``DeformingMethod`` deforms a body that another method posed, a ``LibraryDeformation`` does so by
another library.
"""

from regkit.deformation.deforming_method import Deformed, DeformingMethod
from regkit.deformation.features import Features
from regkit.deformation.field import DisplacementField
from regkit.deformation.fitting import Fit, Stage, fitted
from regkit.deformation.library_method import Displaced, LibraryDeformation
from regkit.deformation.mixture import FieldPrior
from regkit.deformation.moving import InterpolatedDisplacements, KernelDisplacements

__all__ = [
    "Deformed",
    "DeformingMethod",
    "Displaced",
    "DisplacementField",
    "Features",
    "FieldPrior",
    "Fit",
    "InterpolatedDisplacements",
    "KernelDisplacements",
    "LibraryDeformation",
    "Stage",
    "fitted",
]
