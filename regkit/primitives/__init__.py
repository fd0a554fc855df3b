"""Primitives: what shape models make of a body, and what kernels see.

They are carried by segments, placed in the world, and answered with wrenches, which are accumulated
on the segments again.
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
