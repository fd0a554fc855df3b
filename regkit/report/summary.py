"""All metrics as JSON and as CSV tables, for use in other programs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from regkit.metrics import METRICS, mean_of, summary
from regkit.metrics.statistics import Interval
from regkit.report.figures.joints import errors_of, joint_means
from regkit.report.plot import Value, write_csv
from regkit.report.run import Run
from regkit.system.arrays import Array


def metrics(run: Run) -> dict[str, Any]:
    """Returns the contents of ``metrics.json``: metrics by method and recording, and statistics.

    All metrics of a failed recording are None, and ``error`` holds the reason.
    """
    methods = {}
    for method, by_recording in run.measures.items():
        recordings: dict[str, Any] = {name: one.to_dict() for name, one in by_recording.items()}
        for recording, reason in run.failures.get(method, {}).items():
            recordings[recording] = mean_of([]).to_dict() | {"error": reason}
        found = list(by_recording.values())
        over = {name: summary([getattr(one, name) for one in found]) for name in METRICS}
        methods[method] = {
            "recordings": recordings,
            "mean": mean_of(found).numbers(),
            "median": {name: one.median for name, one in over.items()},
            "interval": {name: _listed(one.interval) for name, one in over.items()},
            "joints": _joints(run, method),
            "parts": _parts(run, method),
        }
    pairs = [asdict(pair) | {"interval": _listed(pair.interval)} for pair in run.pairs()]
    return {"methods": methods, "pairs": pairs}


def write_tables(run: Run, folder: Path) -> None:
    """Writes the same as CSV files in ``folder``.

    Raises:
        DataError: If a file cannot be written.
    """
    write_csv(
        folder / "recordings.csv", ["method", "recording", "verdict", *METRICS, "error"], _each(run)
    )
    rows = []
    for method, by_recording in run.finished.items():
        for name in METRICS:
            over = summary([getattr(one, name) for one in by_recording.values()])
            rows.append([method, name, over.n, over.mean, over.median, *_ends(over.interval)])
    columns = ["method", "metric", "recordings", "mean", "median"]
    write_csv(folder / "methods.csv", [*columns, "mean, 95 % from", "to"], rows)
    joints = [
        [method, joint, one["raw_cm"], one["adjusted_cm"]]
        for method in run.finished
        for joint, one in _joints(run, method).items()
    ]
    write_csv(folder / "joints.csv", ["method", "joint", "raw [cm]", "adjusted [cm]"], joints)
    parts = [
        [method, part, one["raw_cm"], one["adjusted_cm"]]
        for method in run.finished
        for part, one in _parts(run, method).items()
    ]
    if parts:
        write_csv(folder / "parts.csv", ["method", "part", "raw [cm]", "adjusted [cm]"], parts)
    write_csv(
        folder / "pairs.csv",
        ["metric", "method", "other", "recordings", "won", "tied", "median difference",
         "95 % from", "to", "p (Wilcoxon)", "p (Holm)"],
        [
            [one.metric, one.method, one.other, one.n, one.won, one.tied, one.difference,
             *_ends(one.interval), one.p, one.p_holm]
            for one in run.pairs()
        ],
    )  # fmt: skip


def _each(run: Run) -> Iterator[list[Value]]:
    for method, by_recording in run.measures.items():
        for recording, measure in by_recording.items():
            numbers = (getattr(measure, name) for name in METRICS)
            yield [method, recording, measure.verdict, *numbers, None]
        for recording, reason in run.failures.get(method, {}).items():
            yield [method, recording, None, *(None for _ in METRICS), reason]


def _joints(run: Run, method: str) -> dict[str, dict[str, float | None]]:
    errors = errors_of(run, method)
    raw, adjusted = (joint_means(errors, kind) for kind in ("raw", "adjusted"))
    return {
        joint: {"raw_cm": mean, "adjusted_cm": adjusted.get(joint)} for joint, mean in raw.items()
    }


def _parts(run: Run, method: str) -> dict[str, dict[str, float | None]]:
    """Returns the mean error of each part over its joints and all frames."""
    errors = errors_of(run, method)
    found: dict[str, dict[str, float | None]] = {}
    for part in dict.fromkeys(name for one in errors for name in one.parts if name):
        own = [one.of_part(part) for one in errors if part in one.parts]
        raw, adjusted = (
            np.concatenate([getattr(one, kind).ravel() for one in own])
            for kind in ("raw", "adjusted")
        )
        found[part] = {"raw_cm": _mean_cm(raw), "adjusted_cm": _mean_cm(adjusted)}
    return found


def _mean_cm(distances: Array) -> float | None:
    known = distances[np.isfinite(distances)]
    return 100.0 * float(known.mean()) if len(known) else None


def _listed(interval: Interval | None) -> list[float] | None:
    return None if interval is None else list(interval)


def _ends(interval: Interval | None) -> tuple[float | None, float | None]:
    return interval or (None, None)
