"""Track losses: when a body was lost, and for how long."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from regkit.metrics.thresholds import fraction_within
from regkit.system.arrays import Array

HALF = 0.5
"""A frame is lost if less than this fraction of its known joints is within the PCK threshold."""


@dataclass(frozen=True)
class Losses:
    """The frames in which a body was lost.

    Attributes:
        lost: Mask of the lost frames, (T,); a frame without a known joint is not lost.
    """

    lost: NDArray[np.bool_]

    @classmethod
    def of(cls, distances: Array, threshold: float) -> Self:
        """Returns the losses of joint distances (T, J) [m] for the PCK threshold [m]."""
        return cls(np.asarray(fraction_within(distances, threshold, axis=1) < HALF))

    def intervals(self) -> list[tuple[int, int]]:
        """Returns each interval of lost frames as its first frame and the frame after its last."""
        steps = np.diff(np.concatenate([[0], self.lost.astype(int), [0]]))
        firsts, ends = np.flatnonzero(steps == 1), np.flatnonzero(steps == -1)
        return [(int(first), int(end)) for first, end in zip(firsts, ends, strict=True)]

    def recovery(self, fps: float) -> float | None:
        """Returns the mean duration of the intervals [s]; None if there is none.

        An interval that lasts to the end of the recording counts with its observed duration.

        Args:
            fps: Frames per second of the recording.
        """
        lengths = [end - first for first, end in self.intervals()]
        return float(np.mean(lengths)) / fps if lengths else None

    @property
    def at_end(self) -> bool:
        """Whether the body is lost in the last frame."""
        return bool(self.lost[-1:].any())
