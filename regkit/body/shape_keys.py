"""Keys of a template's lists of primitives: ``KIND``, or ``KIND/NAME`` for a named list."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Annotated

from pydantic import Field

NAME = "[A-Za-z0-9][A-Za-z0-9_.-]*"
"""Regular expression of a list's name."""

KEY = f"^[^/]*(/{NAME})?$"
"""Regular expression of a key."""

ListName = Annotated[str, Field(pattern=f"^{NAME}$")]
"""Name of a list of primitives: a letter or digit, then letters, digits, ``_``, ``-`` and ``.``."""


def list_key(kind: str, name: str | None) -> str:
    """Returns the key of a kind's named list, or of its list without a name."""
    return kind if name is None else f"{kind}/{name}"


def kind_of(key: str) -> str:
    """Returns the kind of the shape model whose primitives are listed under a key.

    Raises:
        ValueError: If the key is neither ``KIND`` nor ``KIND/NAME``.
    """
    kind, slash, name = key.partition("/")
    if slash and not re.fullmatch(NAME, name):
        raise ValueError(
            f"'{key}' is neither a kind of shape model nor KIND/NAME; a name is a letter or digit, "
            "then letters, digits, '_', '-' and '.'"
        )
    return kind


def names_of(kind: str, keys: Iterable[str]) -> list[str]:
    """Returns the names of a kind's named lists, of all keys of a template's lists."""
    return [key.removeprefix(f"{kind}/") for key in keys if key.startswith(f"{kind}/")]


def named_keys(kind: str) -> str:
    """Returns the regular expression of the keys of a kind's named lists, as JSON Schema has it."""
    plain = re.sub(r"([.*+?^${}()|\[\]\\])", r"\\\1", kind)
    return f"^{plain}/{NAME}$"
