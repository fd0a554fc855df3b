"""Differences between two configurations."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

SHOWN = 3
"""Maximum number of listed differences."""


def differences(there: Any, here: Any) -> str:
    """Returns a short text of the fields in which two configurations differ."""
    found = [f"{field} is {old} there and {new} here" for field, old, new in _all("", there, here)]
    more = len(found) - SHOWN
    return ", ".join(found[:SHOWN]) + (f", and {more} more" if more > 0 else "")


def different(there: Any, here: Any) -> list[str]:
    """Returns the fields in which two configurations differ."""
    return [field for field, *_ in _all("", there, here)]


def _all(field: str, there: Any, here: Any) -> Iterator[tuple[str, str, str]]:
    if isinstance(there, list) and isinstance(here, list):
        there, here = dict(enumerate(there)), dict(enumerate(here))
    if isinstance(there, dict) and isinstance(here, dict):
        for key in there | here:
            inner = f"{field}.{key}" if field else str(key)
            yield from _all(inner, there.get(key, _NOTHING), here.get(key, _NOTHING))
    elif there != here:
        yield field, _text(there), _text(here)


def _text(value: Any) -> str:
    if value is _NOTHING:
        return "not given"
    if value is None:
        return "null"
    if isinstance(value, dict):
        return str(value.get("kind", "a mapping"))
    return str(value)


_NOTHING = object()
