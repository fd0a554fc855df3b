"""Progress of a run, and the handling of interrupts between two frames."""

from __future__ import annotations

from types import TracebackType

from regkit.cli.console import errors
from regkit.cli.interrupt import Interrupt
from regkit.cli.progress import display
from regkit.system.errors import RegkitError


class RunProgress:
    """Shows the whole run and the current tasks, and prints failures.

    Interrupts are handled between two frames, and while workers are busy.
    """

    def __init__(self, interrupt: Interrupt, *, frames: bool) -> None:
        """``frames`` tells whether ``advance`` is called for each frame."""
        self._interrupt = interrupt
        self._frames = frames
        self._whole: int | None = None
        self._current: dict[str, int] = {}

    def __enter__(self) -> RunProgress:
        """Shows nothing before the first task."""
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
        if self._whole is not None:
            display.end(self._whole, keep=True)

    def planned(self, tracks: int, finished: int) -> None:
        """Shows the number of tracks, and how many are finished."""
        self._whole = display.begin("recordings x methods", tracks, finished)

    def begin(self, label: str, frames: int | None) -> None:
        """Shows a task."""
        self._interrupt.check()
        self._current[label] = display.begin(label, frames if self._frames else None)

    def advance(self) -> None:
        """Advances by one frame."""
        self._interrupt.check()
        for task in self._current.values():
            display.advance(task)

    def wait(self) -> None:
        """Handles an interrupt while workers are busy."""
        self._interrupt.check()

    def end(self, label: str, tracks: int, error: RegkitError | None) -> None:
        """Removes a task, and prints its error if it failed."""
        if error is not None:
            errors.print(
                f"{label} failed: {error}", style="red",
            )  # fmt: skip
        self._remove(label)
        if self._whole is not None:
            display.advance(self._whole, tracks)

    def _remove(self, label: str) -> None:
        task = self._current.pop(label, None)
        if task is not None:
            display.end(task)
