"""The complete noise model of a depth camera."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from regkit.config.model import Model
from regkit.sensors.noise.parts import (
    AxialNoise,
    FlyingPixels,
    LateralNoise,
    MissingPixels,
)
from regkit.sensors.raycast import View
from regkit.system.arrays import Array


class DepthNoise(Model):
    """The noise of a depth camera; an absent part has no effect.

    Noise is independent between pixels and frames. The fixed-pattern noise of real cameras is not
    modelled.
    """

    lateral: LateralNoise | None = None
    """Lateral noise: a pixel measures the depth of a nearby one."""
    flying: FlyingPixels | None = None
    """Flying pixels: pixels at edges with a depth between two surfaces."""
    axial: AxialNoise | None = None
    """Axial noise: Gaussian noise of the depth."""
    inverse_depth_step: Annotated[float, Field(ge=1e-9, le=1e3)] | None = None
    """Quantisation step of the inverse depth [1/m]: for triangulation, the step of the disparity
    divided by focal length [px] and baseline [m] (Khoshelham and Elberink, Sensors 2012). A
    time-of-flight camera is quantised by the stored units only."""
    missing: MissingPixels | None = None
    """Invalid pixels."""

    def applied(self, view: View, random: np.random.Generator) -> Array:
        """Returns the measured depth (H, W) [m] of a view; 0 for invalid pixels.

        Each part has its own random numbers, so disabling one does not change the others.
        """
        lateral, flying, missing = random.spawn(3)
        if self.lateral is not None:
            view = self.lateral.applied(view, lateral)
        depth = view.depth
        if self.flying is not None:
            depth = self.flying.applied(depth, flying)
        if self.axial is not None:
            depth = self.axial.applied(View(depth, view.cosines), random)
        if self.inverse_depth_step is not None:
            depth = quantised(depth, self.inverse_depth_step)
        if self.missing is not None:
            depth = np.where(self.missing.missing(view, missing), 0.0, depth)
        return depth


def quantised(depth: Array, step: float) -> Array:
    """Returns depths (...) [m] whose inverses are multiples of ``step`` [1/m]; 0 for invalid ones.

    A depth whose inverse is less than half a step becomes invalid.
    """
    seen = depth > 0.0
    multiples = np.rint(1.0 / np.where(seen, depth, np.inf) / step)
    measured = multiples > 0.0
    return np.where(measured, 1.0 / (np.where(measured, multiples, 1.0) * step), 0.0)


def plain(sigma: float) -> DepthNoise:
    """Returns Gaussian noise with a constant standard deviation [m]."""
    return DepthNoise(axial=AxialNoise(constant=sigma))
