"""Notes: what a reader passed over, assumed or repaired, told without stopping."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from regkit.system.printable import cut, one_line, printable


class RegkitWarning(UserWarning):
    """Something that a user should know of a result; the CLI prints it on standard error."""


def note(message: str, *, place: Path | str | None = None) -> None:
    """Tells a user what was passed over, assumed or repaired, as a ``RegkitWarning``.

    Python shows the same text once per process; ``warnings.filterwarnings`` turns it into an error
    or hides it.

    Args:
        message: What was done with which value, and what it means for the result.
        place: The place, as in a ``RegkitError``.
    """
    text = printable(cut(message))
    text = text if place is None else f"{one_line(str(place))}: {text}"
    warnings.warn(RegkitWarning(text), stacklevel=2)


def show_notes(show: Callable[[str], None] | None = None) -> None:
    """Shows the notes of this process as lines for users, each text once.

    Other warnings stay as they are.

    Args:
        show: Shows a note; by default it is printed on standard error.
    """
    usual = warnings.showwarning
    # Python forgets what it has shown whenever anyone changes the filters of warnings.
    told: set[str] = set()

    def shown(message: Warning | str, category: type[Warning], *place: Any, **more: Any) -> None:
        if issubclass(category, RegkitWarning):
            text = str(message)
            if text not in told:
                told.add(text)
                (show or _printed)(text)
        else:
            usual(message, category, *place, **more)

    warnings.showwarning = shown
    warnings.simplefilter("default", RegkitWarning)


@contextmanager
def collected_notes() -> Iterator[list[str]]:
    """Context manager: the notes of this process go into a list, for another process to show."""
    found: list[str] = []
    usual = warnings.showwarning
    show_notes(found.append)
    try:
        yield found
    finally:
        warnings.showwarning = usual


def tell_again(notes: Iterable[str]) -> None:
    """Tells the notes of another process, those that this one has told already not again."""
    for text in notes:
        warnings.warn(RegkitWarning(text), stacklevel=2)


def _printed(text: str) -> None:
    print(f"warning: {text}", file=sys.stderr)
