"""Pixels without a measurement, where a camera measures what is around them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy
from numpy.typing import NDArray

from regkit.interfaces import Chain, Expected
from regkit.observation import Frame
from regkit.observation.unknown_cuts import wide_part
from regkit.system.arrays import Array

AROUND, MOST = 0.25, 0.5
"""Side of the square around a pixel, as a fraction of the image's longer side, and the share of it
that must be measured. Chosen on three pictures of a first Kinect and on the synthetic rooms: the
shadows and margins are unknown, and the sky above a floor is not."""

NARROW = 0.02
"""Narrower regions, as such a fraction, are no shadows but the noise of outlines, which free space
is told by."""


@dataclass(frozen=True)
class Surroundings(Chain):
    """A chain that marks pixels without a measurement as unknown after its steps.

    Before them, shadows would seem to hide the way from each piece to the next.
    """

    def segmented(self, frame: Frame, expected: Expected | None) -> Frame:
        """Returns the frame after all steps, with its unknown pixels."""
        left = super().segmented(frame, expected)
        if frame.depth is None:
            return left
        measured = (frame.depth > 0.0).astype(np.float64)
        side = max(1, round(AROUND * max(measured.shape)))
        return with_unmeasured(
            left, frame.depth, scipy.ndimage.uniform_filter(measured, side) > MOST
        )


def with_unmeasured(left: Frame, depth: Array, region: NDArray[np.bool_]) -> Frame:
    """Returns a segmented frame, whose pixels without a measurement are unknown in a region.

    In a room a camera would measure the wall behind a free pixel. What it does not measure is too
    near, dark or shiny, or in the shadow of something: the body may be there.

    Args:
        left: What is left of the frame.
        depth: Its depth image before the segmentation, (H, W) [m].
        region: Where the surroundings are measured, (H, W).
    """
    if left.depth is None:
        return left
    width = max(1, round(NARROW * max(depth.shape)))
    unknown = wide_part((depth == 0.0) & region, width)
    return replace(left, depth=np.where(unknown, np.nan, left.depth)) if unknown.any() else left
