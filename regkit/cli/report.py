"""``regkit report``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from regkit.cli.console import output
from regkit.config.model import did_you_mean
from regkit.experiment import found
from regkit.experiment import report as write_report
from regkit.system.errors import ConfigError
from regkit.system.progress import working


def report(
    folder: Annotated[
        Path, typer.Argument(metavar="RESULTS", help="Results folder of a run.", show_default=False)
    ],
    compare: Annotated[
        list[str] | None,
        typer.Option(
            metavar="A,B", help="Also compare these two methods statistically. Repeatable."
        ),
    ] = None,
) -> None:
    """Write the report of a results folder again, also after an interrupted run."""
    measures, failures = found(folder)
    pairs = [_pair(text, list(measures)) for text in compare or ()]
    with working("writing the report"):
        page = write_report(folder, measures, failures, pairs)
    output.print(f"report: {page}")


def _pair(text: str, methods: list[str]) -> tuple[str, str]:
    """Returns the two methods of ``--compare``.

    Raises:
        ConfigError: If they are not two different methods of the results.
    """
    place = f"--compare {text}"
    parts = text.split(",")
    # The name of a sweep's variant may contain commas itself.
    splits = [(",".join(parts[:k]), ",".join(parts[k:])) for k in range(1, len(parts))]
    if not splits:
        raise ConfigError("name two different methods, as in A,B", place=place)
    one, other = next((pair for pair in splits if {*pair} <= {*methods}), splits[0])
    for name in (one, other):
        if name not in methods:
            known = ", ".join(methods)
            raise ConfigError(
                f"no method '{name}' in the results (there are: {known})"
                + did_you_mean(name, methods),
                place=place,
            )
    if one == other:
        raise ConfigError("name two different methods, as in A,B", place=place)
    return one, other
