"""A depth camera's noise as a whole."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from regkit.config.model import Model
from regkit.system.arrays import Array
from regkit_synthesis.cameras.raycast import View
from regkit_synthesis.noise.parts import (
    AxialNoise,
    FlyingPixels,
    LateralNoise,
    MissingPixels,
)


class DepthNoise(Model):
    """What a depth camera makes of the true depth; a part that is absent does nothing.

    Noise is independent from pixel to pixel and from frame to frame; real cameras also err in
    patterns that stay, which this leaves out.
    """

    lateral: LateralNoise | None = None
    """A pixel measures what is seen a little to its side."""
    flying: FlyingPixels | None = None
    """Pixels at edges that measure something between two surfaces."""
    axial: AxialNoise | None = None
    """Gaussian noise of the depth."""
    inverse_depth_step: Annotated[float, Field(gt=0.0)] | None = None
    """Inverse depths are whole multiples of this [1/m]: what triangulates knows its disparity in
    steps, and this is a step over the focal length [px] and the baseline [m] (Khoshelham and
    Elberink, Sensors 2012). A time of flight has the units in which the depth is stored."""
    missing: MissingPixels | None = None
    """Pixels that measure nothing."""

    def applied(self, view: View, random: np.random.Generator) -> Array:
        """The depth (H, W) [m] that is measured of a view; 0 where nothing is.

        Each part has random numbers of its own: without one of them, the others do the same.
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
    """Depths (...) [m] whose inverses are whole multiples of ``step`` [1/m], 0 where there is none.

    What is so far that its inverse is less than half a step is not measured.
    """
    seen = depth > 0.0
    multiples = np.rint(1.0 / np.where(seen, depth, np.inf) / step)
    measured = multiples > 0.0
    return np.where(measured, 1.0 / (np.where(measured, multiples, 1.0) * step), 0.0)


def plain(sigma: float) -> DepthNoise:
    """Gaussian noise of one standard deviation [m], whatever the depth."""
    return DepthNoise(axial=AxialNoise(constant=sigma))
