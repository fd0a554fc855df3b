"""Numbers and names in the style of a template's YAML."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from typing import Any

from pydantic import BaseModel

from regkit.skeleton.joints import Position, Rotation, Vector

_RESERVED = ("true", "false", "null")

_SIGNED: tuple[Any, ...] = (Vector, Position, Rotation)
"""The types of fields whose numbers may be negative."""


def key(name: str) -> str:
    """Returns a name as the key of a mapping."""
    return f"{word(name)}:"


def word(text: str) -> str:
    """Returns a name, quoted if YAML would read it as a number, truth value or structure."""
    plain = re.fullmatch(r"[A-Za-z_]\w*(/[\w.-]+)?", text) and text.lower() not in _RESERVED
    return text if plain else json.dumps(text)


def row(values: Iterable[float], decimals: int = 4) -> str:
    """Returns several numbers as a list."""
    return f"[{', '.join(number(value, decimals) for value in values)}]"


def number(value: float, decimals: int) -> str:
    """Returns a number aligned with signed ones; degrees omit unnecessary decimals."""
    if decimals == 4:
        return f"{round(value, 4) + 0.0: .4f}"
    return f"{round(value, decimals) + 0.0:g}"


def fields_row(model: BaseModel) -> str:
    """Returns a model in one line: four decimals for lengths, one for degrees, no defaults."""
    fields = [
        f"{word(name)}: {_field(name, getattr(model, name), signed=field.annotation in _SIGNED)}"
        for name, field in type(model).model_fields.items()
        if getattr(model, name) != field.default
    ]
    return f"{{{', '.join(fields)}}}"


def _field(name: str, value: Any, *, signed: bool) -> str:
    match value:
        case float() if name.endswith("_deg"):
            return number(value, 1)
        case float():
            return f"{value:.4f}"
        case (float(), *_) if name.endswith("_deg"):
            return row(value, 1)
        case (float(), *_):
            return row(value) if signed else f"[{', '.join(f'{one:.4f}' for one in value)}]"
        case BaseModel():
            return fields_row(value)
    return json.dumps(value, ensure_ascii=False)
