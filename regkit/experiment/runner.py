"""Running experiments: every method on every recording, what is finished being kept."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from regkit.config.model import did_you_mean
from regkit.experiment.experiment import Experiment
from regkit.experiment.ledger import Ledger, Outcome
from regkit.experiment.lock import locked
from regkit.experiment.progress import Progress, Silent
from regkit.experiment.reporting import report, summarise
from regkit.experiment.results import Results
from regkit.experiment.sweeps.study import Study
from regkit.experiment.workers.packed import check_shared
from regkit.experiment.workers.team import ThisProcess, Workers
from regkit.experiment.workers.working import work
from regkit.system.errors import ConfigError

REPORTING = "writing the report"
"""What is begun last."""


def run(
    experiment: Experiment | Study,
    folder: Path,
    progress: Progress | None = None,
    *,
    only: Iterable[str] = (),
    workers: Workers | None = None,
    figures: bool = True,
) -> Outcome:
    """Run an experiment into its folder; what the folder holds already is not done again.

    A recording that fails does not stop the others. The figures are the same to the last bit,
    whoever does the work, but for the frames per second. While the run goes on ``metrics.json``
    and ``report.md`` tell what is finished, also when it is interrupted; the page and the figures
    are written when all is done.

    Args:
        experiment: What to run; the experiments of a sweep are run into folders of their own.
        folder: Where to.
        progress: Who follows the progress.
        only: Names of the methods to run, with all their variants; all of them if it is empty.
        workers: Who does the work; this process without them.
        figures: Whether the report's figures are drawn; it has its tables in any case.

    Returns:
        All that the folder holds; methods of a sweep are called ``SETTING/METHOD``.

    Raises:
        RegkitError: If nothing can be run: an unknown method, a dataset without recordings, a
            folder that holds something else, workers that are not available.
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
        Results.opened(folder, study.config(), workers.described)
        if study.lists:
            for ledger in ledgers:
                ledger.open(workers.described)
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


def _ledgers(study: Study, folder: Path, only: tuple[str, ...]) -> list[Ledger]:
    """What is known of each experiment before anything is run.

    Raises:
        RegkitError: If a method, a recording or a subject is named that there is not.
    """
    methods = _chosen(study.methods, only)
    ledgers: list[Ledger] = []
    for name, one in study.experiments.items():
        if ledgers and one.dataset == ledgers[-1].experiment.dataset:
            lengths = ledgers[-1].lengths
        else:
            lengths = _lengths(one)
        ledgers.append(Ledger(one, Results(folder / name), methods, lengths, name))
    return ledgers


def _lengths(experiment: Experiment) -> dict[str, int]:
    """The number of frames of each recording, by its name."""
    recordings = experiment.dataset.chosen()
    unknown = experiment.subjects.keys() - {recording.subject for recording in recordings}
    if unknown:
        # Those of other recordings may be given templates, too.
        everything = experiment.dataset.model_copy(update={"recordings": None}).chosen()
        known = sorted({one.subject for one in everything if one.subject is not None})
        for name in sorted(unknown - set(known)):
            raise ConfigError(
                f"no recording shows a subject '{name}' (there are: {', '.join(known) or 'none'})"
                + did_you_mean(name, known),
                place="subjects",
            )
    return {recording.name: recording.length for recording in recordings}


def _chosen(known: list[str], only: tuple[str, ...]) -> list[str]:
    """The methods to run; one that is swept stands for all of its variants."""
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
    """The outcomes of all experiments as one."""
    whole = Outcome({}, {})
    for ledger in ledgers:
        outcome = ledger.outcome
        for method in outcome.measures:
            whole.measures[f"{ledger.setting}/{method}"] = outcome.measures[method]
            whole.failures[f"{ledger.setting}/{method}"] = outcome.failures[method]
    return whole
