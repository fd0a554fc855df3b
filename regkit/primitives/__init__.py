"""Primitives: the geometric elements of shape models, which kernels compare with data.

Each primitive belongs to a segment and is placed in the world by its pose. Kernels return a wrench
per primitive, and the primitives accumulate the wrenches on their segments.
"""

from regkit.primitives.gaussians import Gaussians, SurfaceGaussians
from regkit.primitives.primitives import Placed, Primitives
from regkit.primitives.surfels import PlacedSurfels, Surfels
from regkit.primitives.tapered_capsules import TaperedCapsules
from regkit.primitives.volumes import SPHERE, Volumes

__all__ = [
    "SPHERE",
    "Gaussians",
    "Placed",
    "PlacedSurfels",
    "Primitives",
    "SurfaceGaussians",
    "Surfels",
    "TaperedCapsules",
    "Volumes",
]
