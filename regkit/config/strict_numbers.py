"""Strict numbers in models, equivalent to JSON Schema."""

from __future__ import annotations

import math
from typing import Any, cast

from pydantic_core import CoreSchema, PydanticCustomError, core_schema

LARGEST = 1e15
"""Largest magnitude of a number in a field without bounds of its own; the square of a larger one
leaves no digits to anything else."""

LARGEST_INTEGER = 2**63 - 1
"""Largest integer that arrays hold."""

_OPAQUE = ("cls", "default", "default_factory", "metadata", "serialization", "expected")
"""Parts of a core schema that contain no schema of a value."""


def strict_numbers(schema: CoreSchema, model: type) -> CoreSchema:
    """Returns the schema of ``model`` with numbers and booleans that are not converted from others.

    pydantic's own strict mode would also refuse lists for tuples, which YAML cannot write, and 3.0
    for an integer, which JSON Schema accepts.
    """
    return cast(CoreSchema, _strict(schema, model))


def _strict(part: Any, model: type) -> Any:
    if isinstance(part, list):
        return [_strict(item, model) for item in part]
    if isinstance(part, tuple):
        return tuple(_strict(item, model) for item in part)
    if not isinstance(part, dict):
        return part
    kind = part.get("type")
    if kind == "model" and part.get("cls") is not model:
        return part  # Each model applies the rule to its own numbers.
    if kind in ("int", "float"):
        check = _whole_number if kind == "int" else _number
        return core_schema.no_info_before_validator_function(check, cast(CoreSchema, part))
    if kind == "bool":
        return {**part, "strict": True}
    return {key: value if key in _OPAQUE else _strict(value, model) for key, value in part.items()}


def _number(value: Any) -> Any:
    if isinstance(value, (str, bool)):
        raise PydanticCustomError("number_type", "Input should be a valid number")
    # An infinite number is refused by its own rule, and one that is no number by its type.
    if isinstance(value, (int, float)) and LARGEST < abs(value) < math.inf:
        raise PydanticCustomError("number_size", "Input should be a number between -1e15 and 1e15")
    return value


def _whole_number(value: Any) -> Any:
    if isinstance(value, (str, bool)):
        raise PydanticCustomError("number_type", "Input should be a valid integer")
    if isinstance(value, int) and abs(value) > LARGEST_INTEGER:
        raise PydanticCustomError("number_size", "Input should be an integer of 64 bits")
    return value
