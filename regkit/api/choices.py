"""Plug-ins by name, as a mapping, or made already: what the functions of the API take."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeAlias, TypeVar

from regkit.config.plugin import Plugin
from regkit.interfaces import Template

P = TypeVar("P", bound=Plugin)

Choice: TypeAlias = str | Path | Mapping[str, Any] | P
"""A plug-in's name or preset, a YAML file, a mapping as in an experiment's YAML, or itself."""


def load_template(source: Choice[Template], **options: object) -> Template:
    """A template by its name or from its file.

    Args:
        source: ``"human"``, ``"hand"`` or another kind of template that is installed; the YAML file
            of a template; a cloud or mesh, which is rigid; or a mapping with a ``kind``.
        options: Fields of that kind of template, such as ``height=1.75`` [m] or ``side="left"``.
            A size that is not given is found from the data.

    Raises:
        ConfigError: If there is no such template or option, or the file is wrong.
    """
    if isinstance(source, (str, Path)):
        source = Template.named(str(source))
    if options:
        data = source.model_dump() if isinstance(source, Template) else source
        source = {**data, **options}
    return Template.parse(source, place="load_template", field="template")


def told(choice: Choice[Any]) -> str:
    """What a choice is called in a table."""
    if isinstance(choice, Plugin):
        return choice.kind
    if isinstance(choice, Mapping):
        return str(choice.get("preset", choice.get("kind", "")))
    return str(choice)
