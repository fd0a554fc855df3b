"""Consoles of the commands: results on standard output, everything else on standard error."""

from __future__ import annotations

from rich.console import Console

from regkit.system.errors import RegkitError

# Text of users between two colons, as in :a:, must not turn into an emoji.
output = Console(emoji=False)
errors = Console(stderr=True, emoji=False)


def print_error(error: RegkitError) -> None:
    """Prints an error with the prefix "error" on each of its lines."""
    for line in str(error).splitlines():
        errors.print(f"error: {line}", style="red", markup=False, highlight=False, soft_wrap=True)


def tell_compiling() -> None:
    """Explains on a terminal why the first run on a machine starts late."""
    if errors.is_terminal:
        errors.print("compiling numerical loops (once on this machine) ...", highlight=False)
