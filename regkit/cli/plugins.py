"""``regkit plugins``."""

from __future__ import annotations

import inspect
from typing import Annotated

import typer
from rich.markup import escape
from rich.table import Table

from regkit.cli.completion import plugin_names
from regkit.cli.console import output
from regkit.cli.options import PluginFiles, run_plugin_files
from regkit.config.first_sentence import opening_sentence
from regkit.config.installed import OWN, Installed
from regkit.config.model import did_you_mean
from regkit.config.plugin import Plugin
from regkit.config.preset import preset_file, presets_of
from regkit.interfaces import SLOTS, Solver
from regkit.system.errors import PluginError, RegkitError

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
        _print_fields(kind)
        return
    for slot in SLOTS:
        group = slot.group.removeprefix("regkit.")
        kinds = slot.available().items()
        _print_list(group, {name: _summary(slot, name) + _by(one) for name, one in kinds})
        presets = presets_of(slot.group).items()
        _print_list(
            f"{group}, presets",
            {name: _preset_summary(slot.group, name) + _by(point) for name, point in presets},
        )
    output.print(_limits_table())


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


def _limits_table() -> Table:
    """Returns a table of how each solver enforces joint limits."""
    table = Table(
        "solver", "hinges", "ball joints (swing, twist)", "hard_limits", title="joint limits"
    )
    for name in Solver.available():
        try:
            limits = Solver.load(name).limits
        except PluginError:
            continue  # The list of plug-ins reports why it is broken.
        table.add_row(
            name, escape(limits.hinges), escape(limits.balls), "yes" if limits.hard else "refused"
        )
    return table


def _print_fields(kind: str) -> None:
    named = [slot for slot in SLOTS if kind in slot.available()]
    presets = [slot for slot in SLOTS if kind in presets_of(slot.group)]
    for slot in presets:
        file = preset_file(slot.group, kind)
        output.print(f"# {file}")
        text = file.read_text(encoding="utf-8")
        output.print(text)
    if not named and not presets:
        kinds = [name for slot in SLOTS for name in (*slot.available(), *presets_of(slot.group))]
        raise PluginError(f"no plug-in '{kind}' in any group" + did_you_mean(kind, kinds))
    for slot in named:
        found = slot.load(kind)
        table = Table("field", "default", "description", title=f"{slot.group}: {kind}")
        for name, field in found.model_fields.items():
            default = "required"
            if not field.is_required():
                default = str(field.get_default(call_default_factory=True, validated_data={}))
            table.add_row(
                name, escape(default), escape(" ".join((field.description or "").split()))
            )
        output.print(table)
        output.print(inspect.cleandoc(found.__doc__ or ""), soft_wrap=False)


def _summary(slot: type[Plugin], kind: str) -> str:
    try:
        documentation = inspect.cleandoc(slot.load(kind).__doc__ or "")
    except PluginError as error:
        return f"broken: {error}"
    return documentation.splitlines()[0] if documentation else "(its class has no docstring)"


def _preset_summary(group: str, name: str) -> str:
    """Returns the first sentence of the comment at the top of a preset's file."""
    try:
        text = preset_file(group, name).read_text(encoding="utf-8")
    except (RegkitError, OSError) as error:
        return f"broken: {error}"
    return opening_sentence(text)


def _by(origin: Installed | type[Plugin]) -> str:
    """Returns the distribution of a plug-in that is not of regkit itself."""
    if isinstance(origin, Installed):
        return "" if origin.distributions == (OWN,) else f" [{origin.versions}]"
    return f" [{origin.__module__}]"
