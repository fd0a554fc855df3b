"""What of a Gaussian is compared with data: its volume, or the side that a camera sees."""

from __future__ import annotations

from typing import Literal

from regkit.primitives import Gaussians, SurfaceGaussians

Surface = Literal["volume", "visible"]


def shown(gaussians: Gaussians, surface: Surface) -> Gaussians:
    """The Gaussians, marked for kernels to take their visible side where there is a camera."""
    if surface == "volume":
        return gaussians
    return SurfaceGaussians(
        gaussians.segments, gaussians.centres, gaussians.axes, gaussians.scales, gaussians.weights
    )
