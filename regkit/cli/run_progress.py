"""Progress of a run on a terminal."""

from __future__ import annotations

from types import TracebackType

from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    Task,
    TaskID,
    TextColumn,
    TimeRemainingColumn,
)
from rich.text import Text

from regkit.cli.console import errors
from regkit.cli.interrupt import Interrupt
from regkit.system.errors import RegkitError

SHOWN = 8
"""Maximum number of tasks shown at once."""


class _Done(MofNCompleteColumn):
    """Completed and total steps of a task."""

    def render(self, task: Task) -> Text:
        """Renders nothing for a task without a known number of steps."""
        return Text() if task.total is None else super().render(task)


class RunProgress:
    """Progress bars on a terminal, nothing in a pipe; failures are printed in both.

    One bar shows the whole run, the bars below it the current tasks. Interrupts are handled
    between two frames, and while workers are busy.
    """

    def __init__(self, interrupt: Interrupt, *, frames: bool) -> None:
        """``frames`` tells whether ``advance`` is called for each frame."""
        self._interrupt = interrupt
        self._frames = frames
        self._bars = Progress(
            TextColumn("{task.description}", markup=False),
            BarColumn(),
            _Done(),
            TimeRemainingColumn(elapsed_when_finished=True),
            console=errors,
            disable=not errors.is_terminal,
        )
        self._whole: TaskID | None = None
        self._current: dict[str, TaskID] = {}

    def __enter__(self) -> RunProgress:
        """Shows the bars."""
        self._bars.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Removes all bars but the one of the whole run."""
        for label in list(self._current):
            self._remove(label)
        self._bars.stop()

    def planned(self, tracks: int, finished: int) -> None:
        """Shows the number of tracks, and how many are finished."""
        self._whole = self._bars.add_task("recordings x methods", total=tracks, completed=finished)

    def begin(self, label: str, frames: int | None) -> None:
        """Adds the bar of a task."""
        self._interrupt.check()
        visible = len(self._current) < SHOWN
        total = frames if self._frames else None
        self._current[label] = self._bars.add_task(f"  {label}", total=total, visible=visible)

    def advance(self) -> None:
        """Advances by one frame."""
        self._interrupt.check()
        for task in self._current.values():
            self._bars.advance(task)

    def wait(self) -> None:
        """Handles an interrupt while workers are busy."""
        self._interrupt.check()

    def end(self, label: str, tracks: int, error: RegkitError | None) -> None:
        """Removes the bar of a task, and prints its error if it failed."""
        if error is not None:
            errors.print(
                f"{label} failed: {error}", style="red", markup=False, highlight=False,
                soft_wrap=True,
            )  # fmt: skip
        self._remove(label)
        if self._whole is not None:
            self._bars.advance(self._whole, tracks)

    def _remove(self, label: str) -> None:
        task = self._current.pop(label, None)
        if task is not None:
            self._bars.remove_task(task)
        for shown in list(self._current.values())[:SHOWN]:
            self._bars.update(shown, visible=True)
