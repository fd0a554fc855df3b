"""``regkit run``."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

import typer
from rich.box import SIMPLE_HEAD
from rich.markup import escape
from rich.table import Table

from regkit.cli.console import errors, output, print_warning
from regkit.cli.exit_codes import DONE, INTERRUPTED
from regkit.cli.interrupt import Interrupt
from regkit.cli.options import PluginFiles, Strict, options, run_plugin_files
from regkit.cli.out_folder import check_out, new_folder
from regkit.cli.run_progress import RunProgress
from regkit.cli.verdicts import run_exit_code
from regkit.cli.workers import chosen_workers
from regkit.experiment import Study
from regkit.experiment import run as run_experiment
from regkit.metrics import Measure
from regkit.report.labels import wrapped
from regkit.report.tables import TERMINAL, rows
from regkit.scaffold import examples
from regkit.system.errors import DataError

NAME = 22
"""Width of a method's name in the table."""

SHOWN = 8
"""Maximum number of doubtful tracks that are printed."""

INTERRUPTION = "interrupted; finished work is kept: continue with --out {folder}"


def run(
    experiment: Annotated[
        Path, typer.Argument(metavar="EXPERIMENT", help="The experiment's YAML file.")
    ],
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FOLDER",
            help="Results folder; an unfinished run in it is continued. "
            "(default: results/NAME/DATE-TIME)",
            show_default=False,
        ),
    ] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="a.b.c=VALUE",
            help="Change a YAML value, such as dataset.frames=20. Repeatable.",
        ),
    ] = None,
    plugin: PluginFiles = None,
    only: Annotated[
        list[str] | None, typer.Option(metavar="METHOD", help="Run only this method. Repeatable.")
    ] = None,
    jobs: Annotated[int, typer.Option(min=1, metavar="N", help="Number of worker processes.")] = 1,
    cluster: Annotated[
        str | None,
        typer.Option(
            metavar="SCHEME:ADDRESS",
            help="Run on a Dask cluster, such as dask:tcp://10.0.0.1:8786; its workers must see "
            "the same files.",
        ),
    ] = None,
    strict: Strict = False,
    figures: Annotated[
        bool,
        typer.Option(
            "--figures/--no-figures",
            help="Draw the report's figures at the end; `regkit report` can draw them later.",
        ),
    ] = True,
) -> None:
    """Run an experiment: register the template to every recording with every method.

    Lists under `sweep:` in the YAML file expand into one experiment per combination.
    """
    run_plugin_files(plugin)
    _check_example(experiment)
    workers = chosen_workers(jobs, cluster)
    study = Study.read(experiment, settings or (), called="--set")
    folder = out or new_folder(study.name)
    check_out(folder, whole=True)
    stopping = "stopping" if workers.remote else "stopping after this frame"
    try:
        with (
            options(only="--only"),
            Interrupt(stopping, checked=True) as interrupt,
            RunProgress(interrupt, frames=not workers.remote) as progress,
        ):
            interrupt.last_words = INTERRUPTION.format(folder=folder)
            outcome = run_experiment(
                study, folder, progress, only=only or (), workers=workers, figures=figures
            )
    except KeyboardInterrupt:
        errors.print(INTERRUPTION.format(folder=folder))
        raise typer.Exit(INTERRUPTED) from None
    if any(outcome.measures.values()):
        output.print(_table(outcome.measures))
    output.print(f"results: {folder}")
    output.print(f"report: {folder / 'report.html'}")
    _tell_doubts(outcome.measures)
    code = run_exit_code(outcome, strict=strict)
    if code != DONE:
        raise typer.Exit(code)


def _check_example(experiment: Path) -> None:
    """Raises DataError if an example is named that has not been copied yet."""
    name = experiment.stem
    if not experiment.exists() and name in [one.name for one in examples()]:
        raise DataError(
            f"there is no such file; `regkit example {name}` copies the example, and names the "
            "command that runs it",
            place=str(experiment),
        )


def _tell_doubts(measures: Mapping[str, Mapping[str, Measure]]) -> None:
    """Prints each track in which the body was doubtful or lost, without flooding a terminal."""
    doubts = [
        f"{method} on {recording}, {one.verdict}: {one.reason}"
        for method, by_recording in measures.items()
        for recording, one in by_recording.items()
        if one.reason
    ]
    for doubt in doubts[:SHOWN]:
        print_warning(doubt)
    if len(doubts) > SHOWN:
        print_warning(f"{len(doubts) - SHOWN} more such tracks are in the report")


def _table(measures: dict[str, dict[str, Measure]]) -> Table:
    # All metrics must fit a terminal of 80 characters: titles may break there, names where a
    # sweep joined them, and a longer one anywhere.
    table = Table(box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    table.add_column("method", no_wrap=True)
    table.add_column("rec.")
    for title in TERMINAL.values():
        table.add_column(escape(title), justify="right")
    for name, *figures in rows(measures):
        table.add_row(wrapped(name, NAME), *figures)
    return table
