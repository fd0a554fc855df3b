"""Background of a static camera."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from regkit.system.arrays import Array

SAMPLES = 60
"""Number of frames that determine the background."""


@dataclass(frozen=True)
class StaticBackground:
    """The largest depth that each pixel measured.

    Attributes:
        depth: (H, W) [m]; zero for pixels that never measured.
        margin: Minimum distance of the foreground to the background [m].
    """

    depth: Array
    margin: float

    @classmethod
    def of(cls, depth_of: Callable[[int], Array], length: int, margin: float) -> StaticBackground:
        """Returns the background of a recording.

        Args:
            depth_of: Returns the depth image (H, W) [m] of a frame.
            length: Number of frames.
            margin: Minimum distance of the foreground to the background [m].
        """
        samples = np.unique(np.linspace(0, length - 1, SAMPLES).round().astype(int))
        farthest = depth_of(int(samples[0]))
        for index in samples[1:]:
            farthest = np.maximum(farthest, depth_of(int(index)))
        return cls(farthest, margin)

    def before(self, depth: Array) -> NDArray[np.bool_]:
        """Returns the mask (H, W) of the foreground in a depth image (H, W) [m]."""
        return np.asarray((depth > 0.0) & (depth <= self.depth - self.margin))
