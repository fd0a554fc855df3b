"""What a figure's values on several recordings say together, and how sure that is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from regkit.system.arrays import Array

FEWEST = 6
"""So many recordings allow an interval or a test: of five pairs, none can be significant at 5 %."""

RESAMPLES = 4999
SEED = 20140711
"""Resampling begins here, so that a report written anew says the same."""

ROUNDING = 1e-12
"""Values that differ by no more than this part of the largest one are the same value."""

Interval = tuple[float, float]


@dataclass(frozen=True)
class Summary:
    """A figure over n recordings.

    Attributes:
        n: How many recordings have it.
        mean: The mean, or None if n is 0.
        median: The median, or None if n is 0.
        interval: The 95 % bootstrap interval of the mean, or None if n is too small for one.
    """

    n: int
    mean: float | None
    median: float | None
    interval: Interval | None


def summary(values: Sequence[float | None]) -> Summary:
    """The summary of the values that are there."""
    known = np.array([value for value in values if value is not None], dtype=float)
    if not known.size:
        return Summary(0, None, None, None)
    return Summary(
        n=len(known),
        mean=float(known.mean()),
        median=float(np.median(known)),
        interval=bootstrapped(known, "mean"),
    )


def bootstrapped(values: Array, statistic: Literal["mean", "median"]) -> Interval | None:
    """The 95 % bootstrap interval of a statistic of values (n,); None if they are too few.

    For a mean it is bias-corrected and accelerated; for a median, whose jackknife says nothing,
    it is that of the percentiles.
    """
    if len(values) < FEWEST:
        return None
    # Where only rounding tells values apart, the acceleration is zero by zero.
    if np.ptp(values) <= ROUNDING * np.abs(values).max():
        return float(values.min()), float(values.max())
    # Imported when first used, for it takes its time to load.
    from scipy.stats import bootstrap

    found = bootstrap(
        (values,),
        np.mean if statistic == "mean" else np.median,
        n_resamples=RESAMPLES,
        vectorized=True,
        method="BCa" if statistic == "mean" else "percentile",
        rng=np.random.default_rng(SEED),
    ).confidence_interval
    return float(found.low), float(found.high)


def signed_rank(differences: Array) -> float | None:
    """The p-value of Wilcoxon's two-sided signed-rank test of paired differences (n,).

    Differences of zero say nothing and are left out, as Wilcoxon did; if all are zero, p is 1.
    None if there are too few pairs.
    """
    if len(differences) < FEWEST:
        return None
    differing = differences[differences != 0.0]
    if not differing.size:
        return 1.0
    from scipy.stats import wilcoxon

    return float(wilcoxon(differing).pvalue)


def holm(p_values: Sequence[float | None]) -> list[float | None]:
    """Holm's correction for several tests; a test that was not made stays None."""
    known = [index for index, p in enumerate(p_values) if p is not None]
    values: NDArray[np.float64] = np.array([p_values[index] for index in known], dtype=float)
    corrected: list[float | None] = [None] * len(p_values)
    largest = 0.0
    for rank, place in enumerate(np.argsort(values, kind="stable")):
        largest = max(largest, min(1.0, (len(values) - rank) * float(values[place])))
        corrected[known[place]] = largest
    return corrected
