"""Plug-ins as arguments of the API: by name, as a mapping, or as objects."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias, TypeVar

from regkit.config.plugin import Plugin
from regkit.interfaces import Segmenter, Template

P = TypeVar("P", bound=Plugin)

Choice: TypeAlias = str | Path | Mapping[str, Any] | P
"""A plug-in: a kind or preset, a YAML file, a mapping as in an experiment's YAML, or an object."""

Choices: TypeAlias = Choice[P] | Sequence[Choice[P]]
"""One plug-in, or several in order."""


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


def segmenters_of(choices: Choices[Segmenter] | None, *, place: str) -> tuple[Segmenter, ...]:
    """Returns segmenters in order; the default one for None.

    Raises:
        ConfigError: If there is no such segmenter, or one of its fields is invalid.
    """
    if choices is None:
        choices = [Segmenter.default()]
    elif isinstance(choices, (str, Path, Mapping, Segmenter)):
        choices = [choices]
    return tuple(
        Segmenter.parse(one, place=place, field=f"segmentation[{at}]")
        for at, one in enumerate(choices)
    )
