"""``regkit new``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from regkit.cli.console import output
from regkit.scaffold import Scaffold

KINDS = (
    "shape",
    "kernel",
    "term",
    "segmenter",
    "start",
    "preprocessor",
    "solver",
    "method",
    "tracker",
    "template",
    "dataset",
    "source",
)
"""The kinds of plug-ins that ``regkit.scaffold`` knows; a completion does not import it."""


def new(
    what: Annotated[
        str,
        typer.Argument(
            metavar="WHAT",
            help=f"Kind of plug-in: {', '.join(KINDS[:-1])} or {KINDS[-1]}.",
            autocompletion=lambda incomplete: [one for one in KINDS if one.startswith(incomplete)],
        ),
    ],
    name: Annotated[
        str, typer.Argument(metavar="NAME", help="Name of the plug-in in YAML, such as my_shape.")
    ],
    out: Annotated[
        Path, typer.Option(metavar="FOLDER", help="Folder that receives the package's folder.")
    ] = Path(),
) -> None:
    """Create a package for a plug-in of your own, which passes conformance from the start."""
    scaffold = Scaffold.checked(what, name)
    folder = scaffold.write(out)
    lines = [
        f"written: {folder}",
        f"the {what} is in {folder / 'src' / scaffold.module / f'{what}.py'}; next:",
        f'  cd {folder} && pip install -e ".[testing]"',
        "  pytest",
        f"  {scaffold.command}",
    ]
    for line in lines:
        output.print(line)
