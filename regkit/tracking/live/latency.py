"""Quantiles of times, with memory that does not grow with their number."""

from __future__ import annotations

from math import ceil, floor, log

import numpy as np

SHORTEST, LONGEST = 1e-5, 1e3
"""Range of the times that are told apart [s]."""

RESOLUTION = 1.01
"""Ratio of neighbouring times that are told apart."""


class Quantiles:
    """Counts of times in intervals of equal ratio."""

    def __init__(self) -> None:
        count = ceil(log(LONGEST / SHORTEST, RESOLUTION)) + 1
        self._counts = np.zeros(count, dtype=np.int64)

    def __len__(self) -> int:
        """Number of times."""
        return int(self._counts.sum())

    def add(self, seconds: float) -> None:
        """Counts a time [s]."""
        at = floor(log(max(seconds, SHORTEST) / SHORTEST, RESOLUTION))
        self._counts[min(at, len(self._counts) - 1)] += 1

    def __getitem__(self, quantile: float) -> float:
        """Returns the time [s] that a fraction of all times does not exceed; NaN of none."""
        total = len(self)
        if not total:
            return float("nan")
        at = int(np.searchsorted(np.cumsum(self._counts), quantile * total))
        return float(SHORTEST * RESOLUTION ** (at + 0.5))
