"""Tables of a model's fields: type, default, bounds and description."""

from __future__ import annotations

import importlib
import re
import types
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined

from regkit.config.model import Model
from regkit.config.plugin import Plugin

_BOUNDS = {"ge": "≥", "gt": ">", "le": "≤", "lt": "<", "min_length": "length ≥"}
_NAMES = {str: "text", float: "number", int: "integer", bool: "true or false", Path: "path"}


def fields_text(name: str) -> str:
    """Returns the table of the model ``module:class``."""
    module, _, qualified = name.partition(":")
    return field_table(getattr(importlib.import_module(module), qualified))


def field_table(model: type[BaseModel], *, skipped: tuple[str, ...] = ()) -> str:
    """Returns a Markdown table with a row for each field, or a sentence if there is none."""
    rows = [
        f"| `{name}` | {_cell(_type(field.annotation, field.metadata))} | {_default(field)} | "
        f"{_cell(field.description or '')} |"
        for name, field in model.model_fields.items()
        if name not in skipped
    ]
    if not rows:
        return "It has no options."
    return "\n".join(["| option | type | default | description |", "|---|---|---|---|", *rows])


def models_in(plugin: type[BaseModel]) -> Iterator[type[Model]]:
    """Yields the models, except plug-ins, in the fields of a plug-in."""
    for field in plugin.model_fields.values():
        for part in _leaves(field.annotation):
            if isinstance(part, type) and issubclass(part, Model) and not issubclass(part, Plugin):
                yield part


def _leaves(annotation: Any) -> Iterator[Any]:
    arguments = get_args(annotation)
    if get_origin(annotation) is Literal or not arguments:
        yield annotation
        return
    for argument in arguments[:1] if get_origin(annotation) is Annotated else arguments:
        yield from _leaves(argument)


def _type(annotation: Any, metadata: list[Any]) -> str:
    """Returns a type in words, and its bounds."""
    bounds = [bound for part in metadata for bound in _bounds(part)]
    return ", ".join([_words(annotation), *bounds])


def _words(annotation: Any) -> str:
    origin, arguments = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        return _type(arguments[0], [part for one in arguments[1:] for part in _constraints(one)])
    if origin is Literal:
        return " or ".join(f"`{value}`" for value in arguments)
    if origin in (Union, types.UnionType):
        return " or ".join("null" if part is type(None) else _words(part) for part in arguments)
    if origin is tuple and len(arguments) == 2 and arguments[1] is Ellipsis:
        return f"list of {_words(arguments[0])}"
    if origin is tuple and len(set(arguments)) == 1:
        # The bounds of several equal numbers stand behind them once.
        word, *bounds = _words(arguments[0]).split(", ")
        return ", ".join([f"[{', '.join([word] * len(arguments))}]", *bounds])
    if origin is tuple:
        return f"[{', '.join(_words(part) for part in arguments)}]"
    if origin is dict:
        return f"mapping of {_words(arguments[0])} to {_words(arguments[1])}"
    if isinstance(annotation, type) and issubclass(annotation, Plugin):
        if "group" not in vars(annotation):
            return f"`{annotation.__name__}`"
        page = annotation.group.removeprefix("regkit.")
        return f"[{page.removesuffix('s')}](/reference/plugins/{page}.md)"
    if annotation in _NAMES:
        return _NAMES[annotation]
    name = getattr(annotation, "__name__", str(annotation)).removesuffix("Description")
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name).lower()


def _constraints(part: Any) -> list[Any]:
    """Returns the constraints of a ``Field`` in ``Annotated``, or the constraint itself."""
    return list(part.metadata) if isinstance(part, FieldInfo) else [part]


def _bounds(part: Any) -> Iterator[str]:
    for name, sign in _BOUNDS.items():
        if getattr(part, name, None) is not None:
            yield f"{sign}\N{NO-BREAK SPACE}{getattr(part, name):g}"


def _default(field: FieldInfo) -> str:
    if field.is_required():
        return "required"
    value = field.get_default(call_default_factory=True, validated_data={})
    if value is PydanticUndefined:
        return ""
    return _cell(f"`{_value(value)}`")


def _value(value: Any) -> str:
    """Returns a default as YAML."""
    if value is None or isinstance(value, bool):
        return {None: "null", True: "true", False: "false"}[value]
    if isinstance(value, Plugin):
        return value.kind
    if isinstance(value, BaseModel):
        changed = value.model_dump(exclude_defaults=True, mode="json")
        return str(changed or "{}")
    if isinstance(value, (tuple, list)):
        return f"[{', '.join(map(_value, value))}]"
    return f"{value}"


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")
