"""How far a run is, on a terminal."""

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
"""Of so many things that are being done at once a line is shown."""


class _Done(MofNCompleteColumn):
    """How much is done, of what is told."""

    def render(self, task: Task) -> Text:
        """Nothing of what only tells its end."""
        return Text() if task.total is None else super().render(task)


class RunProgress:
    """Progress on a terminal, silence in a pipe; failures are told in both.

    One bar is that of the whole run; below it is what is being done just now. Between two frames,
    or while workers are busy, it lets an interrupt be answered.
    """

    def __init__(self, interrupt: Interrupt, *, frames: bool) -> None:
        """``frames`` is whether each frame will be told."""
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
        """Show the bars."""
        self._bars.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Leave that of the whole run."""
        for label in list(self._current):
            self._remove(label)
        self._bars.stop()

    def planned(self, tracks: int, finished: int) -> None:
        """Show how much there is to do."""
        self._whole = self._bars.add_task("recordings x methods", total=tracks, completed=finished)

    def begin(self, label: str, frames: int | None) -> None:
        """Show that something is being done."""
        self._interrupt.check()
        visible = len(self._current) < SHOWN
        total = frames if self._frames else None
        self._current[label] = self._bars.add_task(f"  {label}", total=total, visible=visible)

    def advance(self) -> None:
        """Move on by one frame."""
        self._interrupt.check()
        for task in self._current.values():
            self._bars.advance(task)

    def wait(self) -> None:
        """Nothing to show."""
        self._interrupt.check()

    def end(self, label: str, tracks: int, error: RegkitError | None) -> None:
        """Take it away, and say why it failed."""
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
