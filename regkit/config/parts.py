"""The parts of a configuration: fields of models, entries of mappings, items of lists."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from pydantic import BaseModel


def parts_of(value: Any) -> Mapping[Any, Any]:
    """Returns the parts that a value consists of, by name or index; none for other values."""
    if isinstance(value, BaseModel):
        return {name: getattr(value, name) for name in type(value).model_fields}
    if isinstance(value, Mapping):
        return value
    return dict(enumerate(value)) if isinstance(value, list | tuple | set | frozenset) else {}


def placed_parts(value: Any, place: str = "") -> Iterator[tuple[str, Any]]:
    """Yields the parts of a value with their paths, such as ``methods.best.kernel``.

    Args:
        value: The value.
        place: Its own path.
    """
    for name, part in parts_of(value).items():
        yield f"{place}.{name}" if place else str(name), part
