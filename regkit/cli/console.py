"""Where the commands print: results to standard output, everything else to standard error."""

from __future__ import annotations

from rich.console import Console

from regkit.system.errors import RegkitError

# What a user wrote between two colons is no emoji.
output = Console(emoji=False)
errors = Console(stderr=True, emoji=False)


def print_error(error: RegkitError) -> None:
    """Print an error, each of its lines as one."""
    for line in str(error).splitlines():
        errors.print(f"error: {line}", style="red", markup=False, highlight=False, soft_wrap=True)


def tell_compiling() -> None:
    """Say on a terminal why the first run on a machine begins late; a pipe has no one waiting."""
    if errors.is_terminal:
        errors.print("compiling numerical loops (once on this machine) ...", highlight=False)
