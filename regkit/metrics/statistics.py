"""Statistics of a metric over recordings: summaries, bootstrap intervals and paired tests."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from regkit.system.arrays import Array

MIN_SAMPLES = 6
"""Minimum number of recordings for an interval or a test: five pairs cannot be significant at the
5 % level."""

RESAMPLES = 4999
SEED = 20140711
"""Seed of the bootstrap, fixed so that a report is reproducible."""

ROUNDING = 1e-12
"""Values whose difference relative to the largest is at most this are equal."""

Interval = tuple[float, float]


@dataclass(frozen=True)
class Summary:
    """Summary of a metric over n recordings.

    Attributes:
        n: Number of recordings that have the metric.
        mean: The mean; None if n is 0.
        median: The median; None if n is 0.
        interval: 95 % bootstrap interval of the mean; None if n is too small.
    """

    n: int
    mean: float | None
    median: float | None
    interval: Interval | None


def summary(values: Sequence[float | None]) -> Summary:
    """Returns the summary of the values that are not None."""
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
    """Returns the 95 % bootstrap interval of a statistic of values (n,); None if n is too small.

    For the mean it is the bias-corrected and accelerated interval; for the median, whose jackknife
    is degenerate, the percentile interval.
    """
    if len(values) < MIN_SAMPLES:
        return None
    # The acceleration is undefined (0 / 0) for values that are equal up to rounding.
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
    """Returns the p-value of Wilcoxon's two-sided signed-rank test of paired differences (n,).

    Zero differences are discarded, as by Wilcoxon; if all are zero, p is 1. Returns None if n is
    too small.
    """
    if len(differences) < MIN_SAMPLES:
        return None
    differing = differences[differences != 0.0]
    if not differing.size:
        return 1.0
    from scipy.stats import wilcoxon

    return float(wilcoxon(differing).pvalue)


def holm(p_values: Sequence[float | None]) -> list[float | None]:
    """Returns p-values with Holm's correction for multiple tests; None stays None."""
    known = [index for index, p in enumerate(p_values) if p is not None]
    values: NDArray[np.float64] = np.array([p_values[index] for index in known], dtype=float)
    corrected: list[float | None] = [None] * len(p_values)
    largest = 0.0
    for rank, place in enumerate(np.argsort(values, kind="stable")):
        largest = max(largest, min(1.0, (len(values) - rank) * float(values[place])))
        corrected[known[place]] = largest
    return corrected
