"""When a body was lost, and for how long."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from regkit.metrics.thresholds import share_within
from regkit.system.arrays import Array

HALF = 0.5
"""A frame is lost when less than this part of its known joints is near."""


@dataclass(frozen=True)
class Losses:
    """The frames in which a body was lost.

    Attributes:
        lost: Whether it was, (T,); a frame without a known joint is not.
    """

    lost: NDArray[np.bool_]

    @classmethod
    def of(cls, distances: Array, near: float) -> Self:
        """From the distances (T, J) [m] of the joints, and which of them count as near."""
        return cls(np.asarray(share_within(distances, near, axis=1) < HALF))

    def stretches(self) -> list[tuple[int, int]]:
        """Each run of lost frames, as its first frame and the one after its last."""
        steps = np.diff(np.concatenate([[0], self.lost.astype(int), [0]]))
        firsts, ends = np.flatnonzero(steps == 1), np.flatnonzero(steps == -1)
        return [(int(first), int(end)) for first, end in zip(firsts, ends, strict=True)]

    def recovery(self, fps: float) -> float | None:
        """Mean length of the stretches [s]; None if there is none.

        One that the recording's end cuts short counts as long as it was seen to be.
        """
        lengths = [end - first for first, end in self.stretches()]
        return float(np.mean(lengths)) / fps if lengths else None

    @property
    def at_end(self) -> bool:
        """Whether it was not found again before the end."""
        return bool(self.lost[-1:].any())
