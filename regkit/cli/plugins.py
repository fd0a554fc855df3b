"""``regkit plugins``."""

from __future__ import annotations

import importlib
import json
from dataclasses import asdict
from typing import Annotated, Any

import typer
from rich.markup import escape
from rich.table import Table

from regkit.cli.completion import plugin_names
from regkit.cli.console import output
from regkit.cli.options import PluginFiles, run_plugin_files
from regkit.config.fingerprint import plugins_fingerprint
from regkit.config.registry import any_registered
from regkit.system.cache import cache_folder

WIDTH = 20
"""Width of the column of names."""


def plugins(
    kind: Annotated[
        str | None,
        typer.Argument(
            metavar="NAME",
            help="Show the fields of this plug-in, or the file of this preset. (default: list all)",
            show_default=False,
            autocompletion=plugin_names(),
        ),
    ] = None,
    plugin: PluginFiles = None,
) -> None:
    """List the installed plug-ins, or the fields of one of them.

    A plug-in that is not of regkit itself is followed by its distribution.
    """
    run_plugin_files(plugin)
    if kind is not None:
        importlib.import_module("regkit.cli.plugin_fields").print_fields(kind)
        return
    listed = _listed()
    for title, summaries in listed["groups"].items():
        _print_list(title, summaries)
    table = Table(
        "solver", "hinges", "ball joints (swing, twist)", "hard_limits", title="joint limits"
    )
    for row in listed["limits"]:
        table.add_row(*map(escape, row))
    output.print(table)


def _listed() -> dict[str, Any]:
    """Returns a ``PluginList`` as data.

    To import all plug-ins takes more than a second. The list is kept in the cache folder, under the
    fingerprint of all plug-ins, and only if none of them is broken.
    """
    file, fingerprint = cache_folder() / "plugins.json", plugins_fingerprint()
    if not any_registered():
        try:
            kept = json.loads(file.read_text(encoding="utf-8"))
            if kept["fingerprint"] == fingerprint:
                return {"groups": kept["groups"], "limits": kept["limits"]}
        except (OSError, ValueError, KeyError, TypeError):
            pass  # There is no list yet, or an incomplete one.
    made = importlib.import_module("regkit.cli.plugin_list").PluginList.made()
    found: dict[str, Any] = asdict(made)
    if not (made.broken or any_registered()):
        write_json = importlib.import_module("regkit.system.json_files").write_json
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            write_json(file, {"fingerprint": fingerprint, **found})
        except OSError:
            pass  # A folder that cannot be written only costs time.
    return found


def _print_list(title: str, summaries: dict[str, str]) -> None:
    """Prints a line or two for each plug-in of a group, on a terminal of 80 columns."""
    if not summaries:
        return
    table = Table.grid(padding=(0, 1))
    table.add_column(no_wrap=True, min_width=WIDTH)
    for name, summary in summaries.items():
        table.add_row(f"  {escape(name)}", escape(summary))
    output.print(title, style="bold")
    output.print(table)
    output.print()
