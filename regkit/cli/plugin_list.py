"""The list of all plug-ins, made by importing each of them."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from dataclasses import dataclass

from regkit.config.first_sentence import opening_sentence
from regkit.config.installed import OWN, Installed
from regkit.config.plugin import Plugin
from regkit.config.preset import preset_file, presets_of
from regkit.interfaces import SLOTS, Solver
from regkit.system.errors import PluginError, RegkitError

BROKEN = "broken: "
"""Beginning of the summary of a plug-in or preset that cannot be used."""


@dataclass(frozen=True)
class PluginList:
    """What ``regkit plugins`` prints.

    Attributes:
        groups: Summaries by name, by the title of their group.
        limits: Name of each solver, and how it treats hinges, ball joints and ``hard_limits``.
    """

    groups: dict[str, dict[str, str]]
    limits: list[list[str]]

    @classmethod
    def made(cls) -> PluginList:
        """Imports all plug-ins and lists them."""
        groups = {}
        for slot in SLOTS:
            title = slot.group.removeprefix("regkit.")
            kinds, presets = slot.available().items(), presets_of(slot.group).items()
            groups[title] = {name: _summary(slot, name) + _by(one) for name, one in kinds}
            groups[f"{title}, presets"] = {
                name: _preset_summary(slot.group, name) + _by(one) for name, one in presets
            }
        return cls(groups, list(_limits()))

    @property
    def broken(self) -> bool:
        """Whether any plug-in or preset cannot be used."""
        found = [summary for group in self.groups.values() for summary in group.values()]
        return any(summary.startswith(BROKEN) for summary in found)


def _limits() -> Iterator[list[str]]:
    """Yields the row of each solver that is not broken; the list of plug-ins reports the others."""
    for name in Solver.available():
        try:
            limits = Solver.load(name).limits
        except PluginError:
            continue
        yield [name, limits.hinges, limits.balls, "yes" if limits.hard else "refused"]


def _summary(slot: type[Plugin], kind: str) -> str:
    try:
        documentation = inspect.cleandoc(slot.load(kind).__doc__ or "")
    except PluginError as error:
        return f"{BROKEN}{error}"
    return documentation.splitlines()[0] if documentation else "(its class has no docstring)"


def _preset_summary(group: str, name: str) -> str:
    """Returns the first sentence of the comment at the top of a preset's file."""
    try:
        text = preset_file(group, name).read_text(encoding="utf-8")
    except (RegkitError, OSError) as error:
        return f"{BROKEN}{error}"
    return opening_sentence(text)


def _by(origin: Installed | type[Plugin]) -> str:
    """Returns the distribution of a plug-in that is not of regkit itself."""
    if isinstance(origin, Installed):
        return "" if origin.distributions == (OWN,) else f" [{origin.versions}]"
    return f" [{origin.__module__}]"
