"""What is installed in a group of plug-ins, its options from the fields themselves."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from importlib.metadata import EntryPoint

from field_tables import field_table, models_in

from regkit.interfaces import SLOTS
from regkit.model import Model
from regkit.plugin import Plugin
from regkit.preset import preset_file, presets_of


def plugins_text(group: str) -> str:
    """Markdown with a section for each plug-in of a group, and for each of its presets."""
    (slot,) = (slot for slot in SLOTS if slot.group == group)
    return "\n\n".join(_parts(slot))


def _parts(slot: type[Plugin]) -> Iterator[str]:
    yield _prose(slot.__doc__)
    yield f"The interface is {{py:class}}`regkit.interfaces.{slot.__name__}`."
    for kind, origin in slot.available().items():
        plugin = slot.load(kind)
        yield f"## {kind}"
        yield _prose(plugin.__doc__)
        where = f"`{plugin.__module__}.{plugin.__qualname__}`"
        if isinstance(origin, EntryPoint) and origin.dist and origin.dist.name != "regkit":
            where += f", of {origin.dist.name} {origin.dist.version}"
        yield where
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
    """A docstring as Markdown, which shows literals in double backticks as it does in single."""
    return inspect.cleandoc(docstring or "")
