"""Where the commands print: results to standard output, everything else to standard error."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from regkit.config.registry import run_plugin_file
from regkit.system.errors import RegkitError

# What a user wrote between two colons is no emoji.
output = Console(emoji=False)
errors = Console(stderr=True, emoji=False)

PluginFiles = Annotated[
    list[Path] | None,
    typer.Option(
        "--plugin", metavar="FILE", help="Python file that registers plug-ins of your own."
    ),
]


def run_plugin_files(files: Iterable[Path] | None) -> None:
    """Make the plug-ins of ``--plugin`` files available."""
    for file in files or ():
        run_plugin_file(file)


def print_error(error: RegkitError) -> None:
    """Print an error, each of its lines as one."""
    for line in str(error).splitlines():
        errors.print(f"error: {line}", style="red", markup=False, highlight=False, soft_wrap=True)
