"""Old names of plug-ins and their groups, answered with the new ones."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from regkit.config.installed import installed
from regkit.system.errors import PluginError


def check_former(slot: type[Any], kind: str) -> None:
    """Refuses a kind that was renamed, or whose group was renamed.

    Raises:
        PluginError: If it was; the message names the new name.
    """
    for name in slot.available():
        try:
            plugin = slot.load(name)
        except PluginError:
            continue
        if kind in plugin.formerly:
            raise PluginError(f"'{kind}' is now called '{name}'")
    for message in left_behind(slot, kind):
        raise PluginError(message)


def left_behind(slot: type[Any], kind: str | None = None) -> Iterator[str]:
    """Yields a message for each plug-in, or the one of a kind, in a group's old name."""
    if slot.former_group is None:
        return
    for name, found in installed(slot.former_group).items():
        if kind in (None, name):
            yield (
                f"plug-in '{name}' of {found.versions} is in the entry-point group "
                f"'{slot.former_group}', which is now called '{slot.group}'; install a version of "
                "it for this version of regkit"
            )
