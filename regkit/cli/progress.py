"""Progress of long work: bars on a terminal, a line each minute elsewhere."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from threading import Event, Thread
from typing import TYPE_CHECKING, Any

from regkit.cli.console import errors

if TYPE_CHECKING:
    from rich.console import Console

EVERY = 60.0
"""Time [s] between two lines."""

SHOWN = 9
"""Maximum number of bars at once."""

NAMED = 3
"""Maximum number of tasks in a line."""


@dataclass
class _Work:
    """A task: its name, its steps, and its bar on a terminal."""

    what: str
    total: int | None
    done: int
    bar: Any = None

    def __str__(self) -> str:
        return self.what if self.total is None else f"{self.what} {self.done} of {self.total}"


class ProgressDisplay:
    """The progress of this process, from its first task to the end of its last one."""

    def __init__(
        self, console: Console = errors, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._console = console
        self._clock = clock
        self._works: dict[int, _Work] = {}
        self._count = 0
        self._began = 0.0
        self._over = Event()
        self._bars: Any = None

    def begin(self, what: str, total: int | None, done: int = 0) -> int:
        """Shows a task below those that are shown, and returns its number."""
        if not self._works:
            self._start()
        work = _Work(what, total, done)
        if self._bars is not None:
            shown, indent = len(self._works) < SHOWN, "  " if self._works else ""
            work.bar = self._bars.add_task(
                indent + what, total=total, completed=done, visible=shown
            )
        self._count += 1
        self._works[self._count] = work
        return self._count

    def advance(self, task: int, by: int = 1) -> None:
        """Counts steps of a task."""
        work = self._works[task]
        work.done += by
        if self._bars is not None:
            self._bars.advance(work.bar, by)

    def describe(self, task: int, what: str) -> None:
        """Changes the text of a task."""
        self._works[task].what = what
        if self._bars is not None:
            self._bars.update(self._works[task].bar, description=what)

    def end(self, task: int, *, keep: bool = False) -> None:
        """Removes a task; ``keep`` leaves its bar on the terminal."""
        work = self._works.pop(task)
        if self._bars is not None:
            if not keep:
                self._bars.remove_task(work.bar)
            for other in list(self._works.values())[:SHOWN]:
                self._bars.update(other.bar, visible=True)
        if not self._works:
            self._stop()

    def line(self) -> str:
        """Returns the state of all tasks in one line."""
        works = list(self._works.values())
        more = [f"{len(works) - NAMED} more"] if len(works) > NAMED else []
        minutes, seconds = divmod(round(self._clock() - self._began), 60)
        return ", ".join([*map(str, works[:NAMED]), *more]) + f" ({minutes}:{seconds:02d})"

    def _start(self) -> None:
        self._began = self._clock()
        if self._console.is_terminal:
            from regkit.cli.bars import bars

            self._bars = bars(self._console)
            self._bars.start()
        else:
            self._over = Event()
            Thread(target=self._tell, args=(self._over,), daemon=True).start()

    def _stop(self) -> None:
        self._over.set()
        if self._bars is not None:
            self._bars.stop()
            self._bars = None

    def _tell(self, over: Event) -> None:
        while not over.wait(EVERY):
            self._console.print(self.line(), markup=False, highlight=False, soft_wrap=True)


display = ProgressDisplay()
"""The display of the command line."""
