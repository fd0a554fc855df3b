"""Two methods held against each other, recording by recording."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from regkit.metrics.measure import Measure
from regkit.metrics.statistics import Interval, bootstrapped, holm, signed_rank

Measures = Mapping[str, Mapping[str, Measure]]
"""Figures by method and recording."""


@dataclass(frozen=True)
class Pair:
    """A figure, of which less is better, of two methods on the recordings that both finished.

    Attributes:
        figure: Its name in ``Measure``.
        method: The one method.
        other: The other.
        n: Number of recordings.
        won: On how many the figure of ``method`` is smaller.
        tied: On how many both are the same.
        difference: Median of ``method`` less ``other``, in the figure's unit.
        interval: Its 95 % bootstrap interval, or None if n is too small for one.
        p: Of Wilcoxon's signed-rank test, or None if n is too small for one.
        p_holm: The same, corrected for all pairs that are compared in this figure.
    """

    figure: str
    method: str
    other: str
    n: int
    won: int
    tied: int
    difference: float
    interval: Interval | None
    p: float | None
    p_holm: float | None = None


def compared(measures: Measures, figure: str, chosen: Iterable[tuple[str, str]] = ()) -> list[Pair]:
    """The best method against each other one, and chosen pairs, corrected together.

    Args:
        measures: Figures by method and recording.
        figure: Which of them; less is better.
        chosen: Further pairs of methods.
    """
    first = best(measures, figure)
    wanted = [(first, name) for name in measures if name != first] if first is not None else []
    for method, other in chosen:
        if (method, other) not in wanted and (other, method) not in wanted:
            wanted.append((method, other))
    pairs = [
        pair
        for method, other in wanted
        if (pair := _pair(measures, figure, method, other)) is not None
    ]
    corrected = holm([pair.p for pair in pairs])
    return [replace(pair, p_holm=p) for pair, p in zip(pairs, corrected, strict=True)]


def best(measures: Measures, figure: str) -> str | None:
    """The method of the least mean on the recordings that all finished; None if there are none."""
    values = {name: _values(by_recording, figure) for name, by_recording in measures.items()}
    values = {name: known for name, known in values.items() if known}
    if not values:
        return None
    shared = set.intersection(*(set(known) for known in values.values()))
    if not shared:
        return None
    return min(values, key=lambda name: float(np.mean([values[name][s] for s in sorted(shared)])))


def _pair(measures: Measures, figure: str, method: str, other: str) -> Pair | None:
    ours, theirs = (_values(measures.get(name, {}), figure) for name in (method, other))
    shared = [recording for recording in ours if recording in theirs]
    if not shared:
        return None
    differences = np.array([ours[recording] - theirs[recording] for recording in shared])
    return Pair(
        figure=figure,
        method=method,
        other=other,
        n=len(shared),
        won=int((differences < 0.0).sum()),
        tied=int((differences == 0.0).sum()),
        difference=float(np.median(differences)),
        interval=bootstrapped(differences, "median"),
        p=signed_rank(differences),
    )


def _values(by_recording: Mapping[str, Measure], figure: str) -> dict[str, float]:
    found = {recording: getattr(measure, figure) for recording, measure in by_recording.items()}
    return {recording: value for recording, value in found.items() if value is not None}
