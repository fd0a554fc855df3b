"""Short texts of objects that hold arrays, for notebooks and debuggers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np

LONGEST = 60
"""Number of characters of a field's own text that are shown."""


class Brief:
    """Base of classes whose ``repr`` shows the shapes of arrays and the numbers of elements."""

    def __init_subclass__(cls, **options: Any) -> None:
        """Sets ``repr`` before a dataclass would, and unless the class has one of its own."""
        super().__init_subclass__(**options)
        if "__repr__" not in cls.__dict__:
            cls.__repr__ = brief_text  # type: ignore[method-assign]


def brief_text(what: Any) -> str:
    """Returns the class and the fields of a dataclass, each in a few characters."""
    if not is_dataclass(what):
        return f"<{type(what).__name__}>"
    return brief_fields(what, {field.name: getattr(what, field.name) for field in fields(what)})


def brief_fields(what: object, values: Mapping[str, object]) -> str:
    """Returns the class and the given fields, each in a few characters."""
    shown = ", ".join(f"{name}={_brief(value)}" for name, value in values.items())
    return f"{type(what).__name__}({shown})"


def _brief(value: object) -> str:
    if isinstance(value, np.ndarray):
        return f"array{value.shape}"
    text = "" if is_dataclass(value) else repr(value)
    if text and len(text) <= LONGEST:
        return text
    if isinstance(value, (tuple, list, set, frozenset, Mapping)):
        return f"<{len(value)} of {type(value).__name__}>"
    return f"{type(value).__name__}(...)"
