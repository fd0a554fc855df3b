"""Progress of long work, for whoever shows it: a notebook, or what ``show_on`` was given."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Protocol, TypeVar

from regkit.system.notebook import NotebookDisplay, notebook_shell

T = TypeVar("T")


class Display(Protocol):
    """Shows the progress of tasks, which are numbered as they begin."""

    def begin(self, what: str, total: int | None) -> int:
        """Shows a task of ``total`` steps and returns its number."""

    def advance(self, task: int) -> None:
        """Counts one step."""

    def end(self, task: int) -> None:
        """Shows the task no longer."""


_DISPLAYS: list[Display] = []
"""The display of this process, or none."""


def show_on(display: Display) -> None:
    """Shows the progress of this process on a display."""
    _DISPLAYS[:] = [display]


def is_shown() -> bool:
    """Whether a display shows the progress of this process."""
    return _display() is not None


def _display() -> Display | None:
    """Returns the display of this process, which a notebook has without being asked."""
    if not _DISPLAYS and (shell := notebook_shell()) is not None:
        show_on(NotebookDisplay(shell))
    return _DISPLAYS[0] if _DISPLAYS else None


@contextmanager
def working(what: str) -> Iterator[None]:
    """Context manager of work without countable steps.

    Args:
        what: What is done, such as "aligning".
    """
    display = _display()
    if display is None:
        yield
        return
    task = display.begin(what, None)
    try:
        yield
    finally:
        display.end(task)


def steps(items: Iterable[T], what: str, total: int | None) -> Iterator[T]:
    """Yields the items, and counts each when the next one is asked for.

    Args:
        items: The steps.
        what: What is done, such as "tracking".
        total: Their number, if it is known.
    """
    display = _display()
    if display is None:
        yield from items
        return
    task = display.begin(what, total)
    try:
        for item in items:
            yield item
            display.advance(task)
    finally:
        display.end(task)
