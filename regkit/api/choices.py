"""Plug-ins as arguments of the API: by name, as a mapping, or as objects."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeAlias, TypeVar

from regkit.config.plugin import Plugin
from regkit.interfaces import Template

P = TypeVar("P", bound=Plugin)

Choice: TypeAlias = str | Path | Mapping[str, Any] | P
"""A plug-in: a kind or preset, a YAML file, a mapping as in an experiment's YAML, or an object."""


def load_template(source: Choice[Template], **options: object) -> Template:
    """Returns a template by its name or from its file.

    Args:
        source: ``"human"``, ``"hand"`` or another installed kind of template; a template's YAML
            file; a cloud or mesh, which becomes a rigid template; or a mapping with a ``kind``.
        options: Fields of that kind of template, such as ``height=1.75`` [m] or ``side="left"``.
            A missing size is estimated from the data.

    Raises:
        ConfigError: If the template or an option does not exist, or the file is invalid.
    """
    if isinstance(source, (str, Path)):
        source = Template.named(str(source))
    if options:
        data = source.model_dump() if isinstance(source, Template) else source
        source = {**data, **options}
    return Template.parse(source, place="load_template", field="template")


def name_of(choice: Choice[Any]) -> str:
    """Returns the name of a choice for tables."""
    if isinstance(choice, Plugin):
        return choice.kind
    if isinstance(choice, Mapping):
        return str(choice.get("preset", choice.get("kind", "")))
    return str(choice)
