"""Pairwise comparison of methods on the same recordings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from regkit.metrics.measure import Measure
from regkit.metrics.statistics import Interval, bootstrapped, holm, signed_rank

Measures = Mapping[str, Mapping[str, Measure]]
"""Metrics by method and recording."""


@dataclass(frozen=True)
class Pair:
    """Comparison of two methods by a metric, of which less is better, on shared recordings.

    Attributes:
        metric: Name of the metric, a field of ``Measure``.
        method: The first method.
        other: The second method.
        n: Number of recordings that both methods finished.
        won: Number of recordings on which ``method`` has the smaller value.
        tied: Number of recordings with equal values.
        difference: Median of the value of ``method`` minus that of ``other``.
        interval: 95 % bootstrap interval of the difference; None if n is too small.
        p: p-value of Wilcoxon's signed-rank test; None if n is too small.
        p_holm: p-value with Holm's correction for all pairs compared by this metric.
    """

    metric: str
    method: str
    other: str
    n: int
    won: int
    tied: int
    difference: float
    interval: Interval | None
    p: float | None
    p_holm: float | None = None


def compared(measures: Measures, metric: str, chosen: Iterable[tuple[str, str]] = ()) -> list[Pair]:
    """Compares the best method with each other one, and chosen pairs, with a joint correction.

    Args:
        measures: Metrics by method and recording.
        metric: Name of the metric; less is better.
        chosen: Further pairs of methods.
    """
    first = best(measures, metric)
    wanted = [(first, name) for name in measures if name != first] if first is not None else []
    for method, other in chosen:
        if (method, other) not in wanted and (other, method) not in wanted:
            wanted.append((method, other))
    pairs = [
        pair
        for method, other in wanted
        if (pair := _pair(measures, metric, method, other)) is not None
    ]
    corrected = holm([pair.p for pair in pairs])
    return [replace(pair, p_holm=p) for pair, p in zip(pairs, corrected, strict=True)]


def best(measures: Measures, metric: str) -> str | None:
    """Returns the method with the least mean on the recordings that all methods finished.

    Returns None if there is no such recording.
    """
    values = {name: _values(by_recording, metric) for name, by_recording in measures.items()}
    values = {name: known for name, known in values.items() if known}
    if not values:
        return None
    shared = set.intersection(*(set(known) for known in values.values()))
    if not shared:
        return None
    return min(values, key=lambda name: float(np.mean([values[name][s] for s in sorted(shared)])))


def _pair(measures: Measures, metric: str, method: str, other: str) -> Pair | None:
    ours, theirs = (_values(measures.get(name, {}), metric) for name in (method, other))
    shared = [recording for recording in ours if recording in theirs]
    if not shared:
        return None
    differences = np.array([ours[recording] - theirs[recording] for recording in shared])
    return Pair(
        metric=metric,
        method=method,
        other=other,
        n=len(shared),
        won=int((differences < 0.0).sum()),
        tied=int((differences == 0.0).sum()),
        difference=float(np.median(differences)),
        interval=bootstrapped(differences, "median"),
        p=signed_rank(differences),
    )


def _values(by_recording: Mapping[str, Measure], metric: str) -> dict[str, float]:
    found = {recording: getattr(measure, metric) for recording, measure in by_recording.items()}
    return {recording: value for recording, value in found.items() if value is not None}
