"""Options that several commands have, and errors that name the option to be changed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from regkit.config.registry import run_plugin_file
from regkit.system.errors import RegkitError

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


@contextmanager
def options(**names: str) -> Iterator[None]:
    """A context whose errors name options where the library names its arguments.

    Args:
        names: The option of each argument, such as ``voxel="--voxel"``.
    """
    try:
        yield
    except RegkitError as error:
        if error.place not in names:
            raise
        raise type(error)(error.message, place=names[error.place]) from None
