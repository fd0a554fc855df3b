"""Progress in a notebook: bars in the output of the cell that runs."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from html import escape
from typing import Any

EVERY = 0.1
"""Minimum time [s] between two pictures of a bar that advances."""


def notebook_shell() -> Any:
    """Returns IPython's shell if this process is the kernel of a notebook, else None.

    IPython is not imported: where it is not yet, there is no notebook.
    """
    get_ipython = getattr(sys.modules.get("IPython"), "get_ipython", None)
    shell = None if get_ipython is None else get_ipython()
    # On a terminal IPython has a shell too, but no kernel.
    return shell if getattr(shell, "kernel", None) is not None else None


@dataclass
class _Task:
    """A task: its name and its steps."""

    what: str
    total: int | None
    done: int = 0

    def __str__(self) -> str:
        """Returns the name, and the steps if they are counted."""
        return self.what if self.total is None else f"{self.what} {self.done} of {self.total}"

    def html(self) -> str:
        """Returns the bar; one without a known number of steps moves to and fro."""
        state = "" if self.total is None else f" value='{self.done}' max='{self.total}'"
        bar = f"<progress{state} style='width: 16em; vertical-align: middle'></progress>"
        return f"<label style='display: block'>{bar} {escape(str(self))}</label>"


class NotebookDisplay:
    """The progress of a kernel: one output in each cell, with the bars of the tasks that run.

    At the end it shows the last counted task, and nothing if none was counted. The bars are HTML,
    and need no widgets.
    """

    def __init__(self, shell: Any, clock: Callable[[], float] = time.monotonic) -> None:
        self._shell = shell
        self._clock = clock
        self._tasks: dict[int, _Task] = {}
        self._count = 0
        self._ended: _Task | None = None
        self._cell: int | None = None
        self._drawn = 0.0

    def begin(self, what: str, total: int | None) -> int:
        """Shows a task of ``total`` steps and returns its number."""
        if new := self._cell != self._shell.execution_count:
            # What a former cell left behind, for instance when it was interrupted, is over.
            self._cell = self._shell.execution_count
            self._tasks, self._ended = {}, None
        self._count += 1
        self._tasks[self._count] = _Task(what, total)
        self._draw(update=not new)
        return self._count

    def advance(self, task: int) -> None:
        """Counts one step."""
        if task in self._tasks:
            self._tasks[task].done += 1
            if self._clock() - self._drawn >= EVERY:
                self._draw()

    def end(self, task: int) -> None:
        """Shows the task no longer, unless it was counted and nothing else is shown."""
        if ended := self._tasks.pop(task, None):
            self._ended = self._ended if ended.total is None else ended
            self._draw()

    def _draw(self, *, update: bool = True) -> None:
        shown = [*self._tasks.values()] or ([] if self._ended is None else [self._ended])
        self._shell.display_pub.publish(
            {
                "text/html": "".join(task.html() for task in shown),
                "text/plain": ", ".join(map(str, shown)),
            },
            transient={"display_id": f"regkit-progress-{self._cell}"},
            update=update,
        )
        self._drawn = self._clock()
