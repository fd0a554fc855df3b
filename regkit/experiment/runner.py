"""Runs of experiments: every method on every recording; finished work is kept."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from regkit.config.model import did_you_mean
from regkit.experiment.experiment import Experiment
from regkit.experiment.ledger import Ledger, Outcome
from regkit.experiment.lock import locked
from regkit.experiment.opening import Opening
from regkit.experiment.progress import Progress, Silent
from regkit.experiment.reporting import report, summarise
from regkit.experiment.results import Results
from regkit.experiment.sweeps.study import Study
from regkit.experiment.workers.packed import check_shared
from regkit.experiment.workers.team import ThisProcess, Workers
from regkit.experiment.workers.working import work
from regkit.interfaces import Recording
from regkit.system.errors import ConfigError

REPORTING = "writing the report"
"""Label of the last step."""


def run(
    experiment: Experiment | Study,
    folder: Path,
    progress: Progress | None = None,
    *,
    only: Iterable[str] = (),
    workers: Workers | None = None,
    figures: bool = True,
) -> Outcome:
    """Runs an experiment into its folder, and skips work that the folder already contains.

    A failing recording does not stop the others. Results do not depend on the workers, to the last
    bit, apart from frames per second. During the run ``metrics.json`` and ``report.md`` show the
    finished part, also after an interrupt; the full report with its figures follows at the end.

    Args:
        experiment: The experiment; the experiments of a sweep get folders of their own.
        folder: The results folder.
        progress: Observer of the progress.
        only: Names of the methods to run, with all their variants; all methods if empty.
        workers: Workers of the run; this process by default.
        figures: Whether to draw the report's figures; its tables are always written.

    Returns:
        All results in the folder; methods of a sweep are named ``SETTING/METHOD``.

    Raises:
        RegkitError: If nothing can be run: a method is unknown, the dataset has no recordings, the
            folder holds other results, or the workers are not available.
    """
    study = Study.of_one(experiment) if isinstance(experiment, Experiment) else experiment
    workers, progress = workers or ThisProcess(), progress or Silent()
    ledgers = _ledgers(study, folder, tuple(only))
    if workers.remote:
        for one in study.experiments.values():
            check_shared(one)
    if folder.exists() and not folder.is_dir():
        raise ConfigError("this is a file, not a folder", place=str(folder))
    with workers.team() as team, locked(folder) as lock:
        team.serve(lock)
        _open(study, folder, ledgers, workers.described)
        try:
            work(ledgers, team, progress)
        finally:
            for ledger in ledgers:
                ledger.summarise()
            outcome = _together(ledgers) if study.lists else ledgers[0].outcome
            if study.lists:
                summarise(folder, outcome.measures, outcome.failures)
        progress.begin(REPORTING, None)
        for ledger in ledgers:
            ledger.report(figures=figures)
        if study.lists:
            report(folder, outcome.measures, outcome.failures, figures=figures)
        progress.end(REPORTING, 0, None)
    return outcome


def _open(study: Study, folder: Path, ledgers: list[Ledger], workers: str) -> None:
    """Opens the folder, and those of a sweep's experiments within it, and reads their results.

    Raises:
        RegkitError: If one cannot be continued; then none is changed.
    """
    openings = [ledger.opening for ledger in ledgers]
    if study.lists:
        openings.insert(0, Opening(folder, study.config(), ledgers[0].experiment, None))
    moved = [opening.check() for opening in openings][-len(ledgers) :]
    earlier = [ledger.read(told) for ledger, told in zip(ledgers, moved, strict=True)]
    for opening in openings:
        opening.write(workers)
    for results in earlier:
        results.keep()


def _ledgers(study: Study, folder: Path, only: tuple[str, ...]) -> list[Ledger]:
    """Returns the state of each experiment before the run.

    Raises:
        RegkitError: If a named method, recording or subject does not exist.
    """
    methods = _chosen(study.methods, only)
    ledgers: list[Ledger] = []
    for name, one in study.experiments.items():
        if ledgers and one.dataset == ledgers[-1].experiment.dataset:
            recordings = ledgers[-1].recordings
        else:
            with study.located(name):
                recordings = _recordings(one)
        ledgers.append(Ledger(one, Results(folder / name), methods, recordings, name))
    return ledgers


def _recordings(experiment: Experiment) -> dict[str, Recording]:
    """Returns the recordings by name."""
    recordings = experiment.dataset.chosen()
    unknown = experiment.subjects.keys() - {recording.subject for recording in recordings}
    if unknown:
        # Templates may also be given for subjects of recordings that are not selected.
        everything = experiment.dataset.model_copy(update={"recordings": None}).chosen()
        known = sorted({one.subject for one in everything if one.subject is not None})
        for name in sorted(unknown - set(known)):
            raise ConfigError(
                f"no recording has the subject '{name}' (there are: {', '.join(known) or 'none'})"
                + did_you_mean(name, known),
                place=f"subjects.{name}",
            )
    return {recording.name: recording for recording in recordings}


def _chosen(known: list[str], only: tuple[str, ...]) -> list[str]:
    """Returns the methods to run; the name of a swept method selects all of its variants."""
    heads = [name.partition(",")[0] for name in known]
    for name in only:
        if name not in known and name not in heads:
            raise ConfigError(
                f"no method '{name}' (there are: {', '.join(known)})" + did_you_mean(name, known),
                place="only",
            )
    return [name for name, head in zip(known, heads, strict=True)
            if not only or name in only or head in only]  # fmt: skip


def _together(ledgers: list[Ledger]) -> Outcome:
    """Returns the outcomes of all experiments as one."""
    whole = Outcome({}, {})
    for ledger in ledgers:
        outcome = ledger.outcome
        for method in outcome.measures:
            whole.measures[f"{ledger.setting}/{method}"] = outcome.measures[method]
            whole.failures[f"{ledger.setting}/{method}"] = outcome.failures[method]
    return whole
