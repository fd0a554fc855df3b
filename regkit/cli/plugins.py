"""``regkit plugins``."""

from __future__ import annotations

from importlib.metadata import EntryPoint

from rich.table import Table

from regkit.cli.console import PluginFiles, output, run_plugin_files
from regkit.errors import PluginError
from regkit.interfaces import SLOTS
from regkit.plugin import Plugin


def plugins(plugin: PluginFiles = None) -> None:
    """List what is installed, by group, with the distribution that brings it."""
    run_plugin_files(plugin)
    table = Table("group", "kind", "what it is", "from")
    for slot in SLOTS:
        for index, (kind, origin) in enumerate(slot.available().items()):
            table.add_row(
                slot.group.removeprefix("regkit.") if not index else "",
                kind,
                _summary(slot, kind),
                _distribution(origin),
            )
        table.add_section()
    output.print(table)


def _summary(slot: type[Plugin], kind: str) -> str:
    try:
        return (slot.load(kind).__doc__ or "").strip().splitlines()[0]
    except PluginError as error:
        return f"broken: {error}"


def _distribution(origin: EntryPoint | type[Plugin]) -> str:
    if isinstance(origin, EntryPoint):
        return f"{origin.dist.name} {origin.dist.version}" if origin.dist else origin.value
    return origin.__module__
