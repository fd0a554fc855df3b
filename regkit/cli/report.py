"""``regkit report``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from regkit.cli.console import output


def report(
    folder: Annotated[Path, typer.Argument(help="Results folder of a run.", show_default=False)],
    compare: Annotated[
        list[str] | None,
        typer.Option(metavar="A,B", help="Also test these two methods against each other."),
    ] = None,
) -> None:
    """Write the report of a results folder anew, also of a run that was interrupted."""
    from regkit.experiment import found
    from regkit.experiment import report as write_report

    measures, failures = found(folder)
    pairs = [_pair(text, list(measures)) for text in compare or ()]
    page = write_report(folder, measures, failures, pairs)
    output.print(f"report: {page}", highlight=False, soft_wrap=True)


def _pair(text: str, methods: list[str]) -> tuple[str, str]:
    """The two methods of ``--compare``.

    Raises:
        ConfigError: If they are not two that there are.
    """
    from regkit.errors import ConfigError
    from regkit.model import did_you_mean

    place = f"--compare {text}"
    names = [name.strip() for name in text.split(",")]
    for name in names:
        if name not in methods:
            known = ", ".join(methods)
            raise ConfigError(
                f"no method '{name}' in the results (there are: {known})"
                + did_you_mean(name, methods),
                place=place,
            )
    if len(set(names)) != 2:
        raise ConfigError("name two different methods, as in A,B", place=place)
    return names[0], names[1]
