"""Progress bars for a terminal."""

from __future__ import annotations

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    Task,
    TextColumn,
    TimeRemainingColumn,
)
from rich.text import Text


class _Done(MofNCompleteColumn):
    """Completed and total steps of a task."""

    def render(self, task: Task) -> Text:
        """Renders nothing for a task without a known number of steps."""
        return Text() if task.total is None else super().render(task)


def bars(console: Console) -> Progress:
    """Returns bars with their tasks, steps and times."""
    return Progress(
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        _Done(),
        TimeRemainingColumn(elapsed_when_finished=True),
        console=console,
    )
