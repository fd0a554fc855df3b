"""Notes: what a reader passed over, assumed or repaired, told without stopping."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any, cast

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


def print_notes() -> None:
    """Prints notes of this process as plain lines on standard error, without the place in code."""
    usual = warnings.formatwarning

    def formatted(message: Warning | str, category: type[Warning], *rest: Any, **more: Any) -> str:
        if issubclass(category, RegkitWarning):
            return f"warning: {message}\n"
        return usual(message, category, *rest, **more)

    warnings.formatwarning = cast("Any", formatted)
    warnings.simplefilter("default", RegkitWarning)
