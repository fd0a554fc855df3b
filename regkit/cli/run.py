"""``regkit run``."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
from typing import Annotated

import typer
from rich.box import SIMPLE_HEAD
from rich.markup import escape
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TaskID,
    TextColumn,
    TimeRemainingColumn,
)
from rich.table import Table

from regkit.cli.console import PluginFiles, errors, output, run_plugin_files
from regkit.cli.interrupt import Interrupt
from regkit.errors import RegkitError
from regkit.metrics import Measure


def run(
    experiment: Annotated[Path, typer.Argument(help="The experiment's YAML file.")],
    out: Annotated[
        Path | None,
        typer.Option(
            help="Results folder; one that was begun before is completed. "
            "[default: results/NAME/DATE-TIME]",
            show_default=False,
        ),
    ] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="a.b.c=VALUE", help="Change a value of the YAML file."),
    ] = None,
    plugin: PluginFiles = None,
    only: Annotated[
        list[str] | None, typer.Option(metavar="METHOD", help="Run only this method.")
    ] = None,
) -> None:
    """Run an experiment: register the template to every sequence with every method."""
    from regkit.experiment import Experiment
    from regkit.experiment import run as run_experiment

    run_plugin_files(plugin)
    config = Experiment.read(experiment, settings or ())
    folder = out or Path("results") / config.name / f"{datetime.now():%Y%m%d-%H%M%S}"
    try:
        with Interrupt() as interrupt, _ProgressBar(interrupt) as bar:
            outcome = run_experiment(config, folder, bar, only=only or ())
    except KeyboardInterrupt:
        errors.print(
            f"interrupted; what was finished is kept: repeat with --out {folder}",
            highlight=False,
            soft_wrap=True,
        )
        raise typer.Exit(130) from None
    output.print(_table(outcome.measures))
    output.print(f"results: {folder}", highlight=False, soft_wrap=True)
    output.print(f"report: {folder / 'report.html'}", highlight=False, soft_wrap=True)
    if any(outcome.failures.values()):
        raise typer.Exit(1)


def _table(measures: dict[str, dict[str, Measure]]) -> Table:
    from regkit.report.tables import TERMINAL, rows

    # A terminal of 80 characters holds all figures: titles may break there, names may not.
    table = Table(box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    table.add_column("method", no_wrap=True)
    table.add_column("seq.")
    for title in TERMINAL.values():
        table.add_column(escape(title), justify="right")
    for row in rows(measures):
        table.add_row(*row)
    return table


class _ProgressBar:
    """Progress on a terminal, silence in a pipe; failures are told in both.

    Between two frames it lets an interrupt be answered.
    """

    def __init__(self, interrupt: Interrupt) -> None:
        self._interrupt = interrupt
        self._bar = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeRemainingColumn(),
            console=errors,
            disable=not errors.is_terminal,
        )
        self._task: TaskID | None = None

    def __enter__(self) -> _ProgressBar:
        self._bar.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._bar.stop()

    def begin(self, method: str, sequence: str, frames: int) -> None:
        """Show a bar for a sequence."""
        self._interrupt.check()
        self._task = self._bar.add_task(f"{method}  {sequence}", total=frames)

    def advance(self) -> None:
        """Move the bar by one frame."""
        self._interrupt.check()
        if self._task is not None:
            self._bar.advance(self._task)

    def end(self, method: str, sequence: str, outcome: Measure | RegkitError) -> None:
        """Complete the bar, or say why the sequence failed."""
        if isinstance(outcome, RegkitError):
            errors.print(
                f"{method} on {sequence} failed: {outcome}", style="red", markup=False,
                highlight=False, soft_wrap=True,
            )  # fmt: skip
        elif self._task is not None and outcome.frames is not None:
            self._bar.update(self._task, completed=outcome.frames)
