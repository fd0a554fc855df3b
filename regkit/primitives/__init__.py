"""Primitives: the geometric elements into which shape models turn a body, and which kernels see.

Primitives belong to segments. They are placed in the world, kernels return a wrench for each, and
the wrenches are accumulated on the segments.
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
