"""The report of a results folder, from its files alone, without data or plug-ins."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from regkit.config.document import Document
from regkit.config.yaml_source import yaml_source
from regkit.experiment.results import Results
from regkit.experiment.results_format import check_format
from regkit.metrics import Measure
from regkit.report import Run, write_report, write_summary
from regkit.system.errors import DataError
from regkit.system.links import check_links

Measures = Mapping[str, Mapping[str, Measure]]
"""Metrics by method and recording; a method of a sweep is named ``SETTING/METHOD``."""

Failures = Mapping[str, Mapping[str, str]]
"""Reasons of failures, by method and recording."""


def summarise(folder: Path, measures: Measures, failures: Failures) -> None:
    """Writes ``metrics.json`` and ``report.md`` of an unfinished run, without figures."""
    write_summary(_run(folder, measures, failures), folder)


def report(
    folder: Path,
    measures: Measures,
    failures: Failures,
    pairs: Iterable[tuple[str, str]] = (),
    *,
    figures: bool = True,
) -> Path:
    """Writes the report with its figures and tables, and ``metrics.json``.

    Args:
        folder: The results folder.
        measures: Metrics by method and recording.
        failures: Reasons of failures, by method and recording.
        pairs: Pairs of methods to compare, in addition to the best one with each other.
        figures: Whether to draw figures.

    Returns:
        The path of the report.

    Raises:
        DataError: If a file is damaged or cannot be written.
    """
    results = Results(folder)
    records = {
        method: {
            recording: record
            for recording in by_recording
            if (record := results.record(method, recording)) is not None
        }
        for method, by_recording in measures.items()
    }
    run = replace(_run(folder, measures, failures), records=records, chosen=tuple(pairs))
    write_report(run, folder, figures=figures)
    return folder / "report.html"


def found(folder: Path) -> tuple[dict[str, dict[str, Measure]], dict[str, dict[str, str]]]:
    """Returns the metrics and failures in a results folder.

    Methods and recordings are in the order of the configuration and of ``metrics.json``, followed
    by those that neither contains.

    Raises:
        DataError: If it is not a results folder, has another format, or a file is damaged.
    """
    if not folder.exists():
        raise DataError("there is no such folder; name the results of a run", place=str(folder))
    if not (folder / "config.yaml").is_file() or not (folder / "environment.json").is_file():
        raise DataError(
            "this is not a results folder of `regkit run`: it has no config.yaml and "
            "environment.json",
            place=str(folder),
        )
    check_links(folder)
    check_format(folder)
    results, metrics = Results(folder), folder / "metrics.json"
    written_metrics = _json(metrics).get("methods", {}) if metrics.exists() else {}
    config = Document.read(folder / "config.yaml").data
    named = [] if "sweep" in config else config.get("methods", {})
    written = [path.parent.relative_to(folder) for path in sorted(folder.rglob("measure.json"))]
    measures: dict[str, dict[str, Measure]] = {}
    failures: dict[str, dict[str, str]] = {}
    for method in dict.fromkeys(
        [*named, *written_metrics, *(one.parent.as_posix() for one in written)]
    ):
        recordings = written_metrics.get(method, {}).get("recordings", {})
        own = [one.name for one in written if one.parent.as_posix() == method]
        measures[method], failures[method] = {}, {}
        for recording in dict.fromkeys([*recordings, *own]):
            measure = results.finished(method, recording)
            if measure is not None:
                measures[method][recording] = measure
            elif "error" in recordings.get(recording, {}):
                failures[method][recording] = recordings[recording]["error"]
    return measures, failures


def _run(folder: Path, measures: Measures, failures: Failures) -> Run:
    config = folder / "config.yaml"
    return Run(
        config=Document.read(config).data,
        text=yaml_source(config),
        environment=_json(folder / "environment.json"),
        measures=measures,
        failures=failures,
        records={},
    )


def _json(file: Path) -> dict[str, Any]:
    """Returns a JSON object from a file.

    Raises:
        DataError: If it is missing or damaged.
    """
    try:
        data = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise DataError(f"missing or damaged ({error})", place=str(file)) from None
    if not isinstance(data, dict):
        raise DataError("damaged: it holds no JSON object", place=str(file))
    return data
