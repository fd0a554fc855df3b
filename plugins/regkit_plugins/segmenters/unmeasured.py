"""Pixels without a measurement, where a camera measures what is around them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import uniform_filter

from regkit.interfaces import BoundSegmenter, Expected
from regkit.observation import Frame

AROUND, MOST = 0.25, 0.5
"""Side of the square around a pixel, as a fraction of the image's longer side, and the share of it
that must be measured. Chosen on three pictures of a first Kinect and on the synthetic rooms: the
shadows and margins are unknown, and the sky above a floor is not."""


@dataclass(frozen=True)
class Unmeasured(BoundSegmenter):
    """Marks pixels without a measurement as unknown where most pixels around them have one.

    In a room a camera would measure the wall behind a free pixel. What it does not measure is too
    near, dark or shiny, or in the shadow of something: the body may be there.
    """

    def segmented(self, frame: Frame, expected: Expected | None) -> Frame:
        """Returns the frame with its unknown pixels; all points are kept."""
        if frame.depth is None:
            return frame
        measured = (frame.depth > 0.0).astype(np.float64)
        side = max(1, round(AROUND * max(measured.shape)))
        return with_unknown(frame, uniform_filter(measured, side) > MOST)


def with_unknown(frame: Frame, surrounded: NDArray[np.bool_]) -> Frame:
    """Returns a frame whose pixels without a measurement are unknown in a region.

    Args:
        frame: The frame, with a depth image (H, W).
        surrounded: The region, (H, W).
    """
    assert frame.depth is not None
    unknown = surrounded & (frame.depth == 0.0)
    if not unknown.any():
        return frame
    return replace(frame, depth=np.where(unknown, np.nan, frame.depth))
