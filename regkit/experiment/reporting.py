"""The report of a results folder, from its files alone, without data or plug-ins."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path

from regkit.experiment.provenance import manifest
from regkit.experiment.provenance.contents import Contents
from regkit.experiment.results import Results
from regkit.experiment.results_format import check_format
from regkit.experiment.scenes import write_replay
from regkit.experiment.stated import read_config, read_environment
from regkit.experiment.summary_file import SummaryFile
from regkit.metrics import Measure
from regkit.report import Run, write_report, write_summary
from regkit.system.errors import DataError
from regkit.system.links import check_links
from regkit.system.notes import note

Measures = Mapping[str, Mapping[str, Measure]]
"""Metrics by method and recording; a method of a sweep is named ``SETTING/METHOD``."""

Failures = Mapping[str, Mapping[str, str]]
"""Reasons of failures, by method and recording."""


def summarise(folder: Path, measures: Measures, failures: Failures) -> None:
    """Writes ``metrics.json`` and ``report.md`` of an unfinished run, without figures."""
    write_summary(run_in(folder, measures, failures), folder)


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
        figures: Whether to draw figures, and to write the replay.

    Returns:
        The path of the report.

    Raises:
        DataError: If a file is damaged or cannot be written.
    """
    results = Results(folder)
    records = {
        method: {recording: results.record(method, recording) for recording in by_recording}
        for method, by_recording in measures.items()
    }
    run = replace(run_in(folder, measures, failures), records=records, chosen=tuple(pairs))
    shown = write_replay(run, results) if figures else None
    write_report(run, folder, figures=figures, replay=shown)
    return folder / "report.html"


def found(folder: Path) -> tuple[dict[str, dict[str, Measure]], dict[str, dict[str, str]]]:
    """Returns the metrics and failures in a results folder.

    Methods and recordings are in the order of the configuration and of ``metrics.json``, followed
    by those that neither contains.

    Raises:
        DataError: If it is not a results folder, has another format, or a file is damaged. A track
            of other data than the recording's latest is told and left out.
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
    results, listed = Results(folder), SummaryFile.read(folder)
    config = read_config(folder)
    named = [] if "sweep" in config else config["methods"]
    written = [path.parent.relative_to(folder) for path in sorted(folder.rglob(manifest.FILE))]
    measures: dict[str, dict[str, Measure]] = {}
    failures: dict[str, dict[str, str]] = {}
    failed, contents = listed.failures(), Contents(folder)
    for method in dict.fromkeys(
        [*named, *listed.methods, *(one.parent.as_posix() for one in written)]
    ):
        recordings = listed.methods[method].recordings if method in listed.methods else {}
        own = [one.name for one in written if one.parent.as_posix() == method]
        measures[method], failures[method] = {}, {}
        for recording in dict.fromkeys([*recordings, *own]):
            measure = None
            if recording in own and contents.current(method, recording):
                measure = results.finished(method, recording)
            if measure is not None:
                measures[method][recording] = measure
            elif recording in failed.get(method, {}):
                failures[method][recording] = failed[method][recording]
            elif recording not in own:
                note(f"{method} on {recording} was finished and is missing; the report leaves it "
                     "out", place=folder)  # fmt: skip
    return measures, failures


def run_in(folder: Path, measures: Measures, failures: Failures) -> Run:
    """Returns the contents of a results folder, without the records of its tracks."""
    return Run(
        config=read_config(folder),
        text=(folder / "config.yaml").read_text(encoding="utf-8"),
        environment=read_environment(folder),
        measures=measures,
        failures=failures,
        records={},
    )
