"""Reference of the plug-ins of a group, with options generated from their fields."""

from __future__ import annotations

import inspect
from collections.abc import Iterator

from field_tables import field_table, models_in

from regkit.config.installed import OWN, only_from
from regkit.config.model import Model
from regkit.config.plugin import Plugin
from regkit.config.preset import preset_file, presets_of
from regkit.interfaces import SLOTS


def plugins_text(group: str) -> str:
    """Returns Markdown with a section for each plug-in and preset of a group.

    Plug-ins of other distributions that happen to be installed are omitted.
    """
    (slot,) = (slot for slot in SLOTS if slot.group == group)
    with only_from(OWN):
        return "\n\n".join(_parts(slot))


def _parts(slot: type[Plugin]) -> Iterator[str]:
    yield _prose(slot.__doc__)
    yield f"The interface is {{py:class}}`regkit.interfaces.{slot.__name__}`."
    for kind in slot.available():
        plugin = slot.load(kind)
        yield f"## {kind}"
        yield _prose(plugin.__doc__)
        yield f"`{plugin.__module__}.{plugin.__qualname__}`"
        yield field_table(plugin, skipped=("kind",))
        for model in models_in(plugin):
            yield from _nested(kind, model)
    yield from _presets(slot)


def _nested(kind: str, model: type[Model]) -> Iterator[str]:
    yield f"### {model.__name__} of {kind}"
    yield _prose(model.__doc__)
    yield field_table(model)


def _presets(slot: type[Plugin]) -> Iterator[str]:
    for name in presets_of(slot.group):
        yield f"## preset {name}"
        text = preset_file(slot.group, name).read_text(encoding="utf-8")
        yield f"```yaml\n{text}```"


def _prose(docstring: str | None) -> str:
    """Returns a docstring as Markdown, which accepts literals in double backticks."""
    return inspect.cleandoc(docstring or "")
