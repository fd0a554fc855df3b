"""The choice between Gaussians as volumes and their visible surfaces."""

from __future__ import annotations

from typing import Literal

from regkit.primitives import Gaussians, SurfaceGaussians

Surface = Literal["volume", "visible"]


def shown(gaussians: Gaussians, surface: Surface) -> Gaussians:
    """Returns the Gaussians; ``visible`` ones make kernels use the surface that the camera sees."""
    if surface == "volume":
        return gaussians
    return SurfaceGaussians(
        gaussians.segments, gaussians.centres, gaussians.axes, gaussians.scales, gaussians.weights
    )
