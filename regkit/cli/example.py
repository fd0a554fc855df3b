"""``regkit example``."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape
from rich.table import Table

from regkit.cli.completion import example_names
from regkit.cli.console import output
from regkit.scaffold import Example, examples


def example(
    name: Annotated[
        str | None,
        typer.Argument(
            metavar="NAME",
            help="Example to copy. (default: list all)",
            show_default=False,
            autocompletion=example_names,
        ),
    ] = None,
    out: Annotated[
        Path, typer.Option(metavar="FOLDER", help="Folder that receives the example's folder.")
    ] = Path(),
) -> None:
    """Copy a runnable example with its data, or list the examples."""
    if name is None:
        table = Table("example", "what it shows")
        for one in examples():
            table.add_row(one.name, escape(one.summary))
        output.print(table)
        output.print("copy one with: regkit example NAME")
        return
    chosen = Example.named(name)
    folder = chosen.copy(out)
    lines = [f"written: {folder}; next:", f"  cd {shlex.quote(str(folder))}", f"  {chosen.command}"]
    for line in lines:
        output.print(line)
