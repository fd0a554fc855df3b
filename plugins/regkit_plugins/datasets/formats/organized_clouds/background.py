"""What a camera that stands still sees behind those who move."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from regkit.system.arrays import Array

SAMPLES = 60
"""How many frames of a recording tell its background."""


@dataclass(frozen=True)
class StaticBackground:
    """The farthest that each pixel measured.

    Attributes:
        depth: (H, W) [m]; zero where nothing ever was.
        margin: What is at least so much nearer is the foreground [m].
    """

    depth: Array
    margin: float

    @classmethod
    def of(cls, depth_of: Callable[[int], Array], length: int, margin: float) -> StaticBackground:
        """The background of a recording.

        Args:
            depth_of: The depth image (H, W) [m] of a frame.
            length: Number of frames.
            margin: What is at least so much nearer is the foreground [m].
        """
        samples = np.unique(np.linspace(0, length - 1, SAMPLES).round().astype(int))
        farthest = depth_of(int(samples[0]))
        for index in samples[1:]:
            farthest = np.maximum(farthest, depth_of(int(index)))
        return cls(farthest, margin)

    def before(self, depth: Array) -> NDArray[np.bool_]:
        """Which pixels of a depth image (H, W) [m] show what stands before the background."""
        return np.asarray((depth > 0.0) & (depth <= self.depth - self.margin))
