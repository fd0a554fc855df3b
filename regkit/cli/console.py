"""Consoles of the commands: results on standard output, everything else on standard error."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from rich.console import Console, ConsoleOptions, RenderableType
from rich.segment import Segment

from regkit.system.errors import RegkitError
from regkit.system.printable import printable


class _SafeConsole(Console):
    """A console that shows names of others as they are.

    Neither brackets nor colons in a line have a meaning; cells of tables escape their brackets.
    Characters that would move the cursor or reorder the text are shown as escapes.
    """

    def print(self, *objects: Any, **options: Any) -> None:
        """Prints tables, and texts in lines of any length."""
        if any(isinstance(one, str) for one in objects):
            options = {"markup": False, "highlight": False, "soft_wrap": True} | options
        super().print(*objects, **options)

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> Iterable[Segment]:
        """Yields the parts of an object, with the text of each safe to print."""
        for part in super().render(renderable, options):
            yield part if part.control else Segment(printable(part.text), part.style)


output = _SafeConsole(emoji=False)
errors = _SafeConsole(stderr=True, emoji=False)


def print_error(error: RegkitError) -> None:
    """Prints an error with the prefix "error" on each of its lines."""
    for line in str(error).splitlines():
        errors.print(f"error: {line}", style="red")


def tell_compiling() -> None:
    """Explains why the first run on a machine starts late, in a log as on a terminal."""
    errors.print("compiling numerical loops (once on this machine, a minute or so) ...")


def print_warning(text: str) -> None:
    """Prints a warning with the prefix "warning" on each of its lines."""
    for line in text.splitlines():
        errors.print(f"warning: {line}", style="yellow")
