"""Files and folders that a configuration names as its inputs."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args

from pydantic import BaseModel

from regkit.config.model import READ
from regkit.config.parts import parts_of


def input_paths(model: BaseModel, beside: type[BaseModel]) -> Iterator[Path]:
    """Yields the paths in fields of the type ``InputPath``, also in models within the model.

    Args:
        model: The configuration.
        beside: Models of this type within it are left out.
    """
    for name, field in type(model).model_fields.items():
        value = getattr(model, name)
        if READ in field.metadata or _names_inputs(field.annotation):
            yield from paths_in(value, beside)
        else:
            for inner in _models(value, beside):
                yield from input_paths(inner, beside)


def paths_in(value: Any, beside: type[BaseModel]) -> Iterator[Path]:
    """Yields all paths in a value, also in models within it but for those of type ``beside``."""
    if isinstance(value, Path):
        yield value
    for part in parts_of(value).values():
        if not isinstance(part, beside):
            yield from paths_in(part, beside)


def _models(value: Any, beside: type[BaseModel]) -> Iterator[BaseModel]:
    if isinstance(value, beside):
        return
    if isinstance(value, BaseModel):
        yield value
    else:
        for part in parts_of(value).values():
            yield from _models(part, beside)


def _names_inputs(annotation: Any) -> bool:
    if READ in getattr(annotation, "__metadata__", ()):
        return True
    return any(_names_inputs(inner) for inner in get_args(annotation))
