"""Names of what a sweep makes: short, readable, and fit for folders."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

LONGEST = 80
"""A longer name is replaced by a number: folders of folders have to fit, too."""


def variants(head: str, values: Mapping[tuple[str, ...], Sequence[Any]]) -> list[str]:
    """The names of all combinations of values, the last field's changing fastest.

    Args:
        head: What every name begins with, such as a method's name, or nothing.
        values: Lists by the way to the field, which is empty if the whole is swept.
    """
    names = [head] if head else [""]
    for way, texts in zip(_shortest(list(values)), map(_texts, values.values()), strict=True):
        names = [",".join(filter(None, (name, f"{way}={text}" if way else text)))
                 for name in names for text in texts]  # fmt: skip
    if max(map(len, names)) <= LONGEST:
        return names
    return [f"{head or 'setting'},{number:03d}" for number in range(1, len(names) + 1)]


def _shortest(ways: list[tuple[str, ...]]) -> list[str]:
    """The shortest ends of the ways that tell them apart, as ``sigma`` of ``kernel.sigma``."""
    ends = []
    for way in ways:
        others = [other for other in ways if other != way]
        length = 1
        # A bare number would name an item of nothing.
        while length < len(way) and (
            way[-length].isdecimal() or any(other[-length:] == way[-length:] for other in others)
        ):
            length += 1
        ends.append(re.sub(r"[^A-Za-z0-9_.-]", "_", ".".join(way[-length:])))
    if len(set(ends)) < len(ends):
        return [f"{end}.{number}" for number, end in enumerate(ends, 1)]
    return ends


def _texts(values: Sequence[Any]) -> list[str]:
    """A text for each value; its number in the list where it has none of its own."""
    texts = [_text(value) for value in values]
    numbers = [f"v{number}" for number in range(1, len(texts) + 1)]
    found = [
        text if text is not None and texts.count(text) == 1 else number
        for text, number in zip(texts, numbers, strict=True)
    ]
    return found if len(set(found)) == len(found) else numbers


def _text(value: Any) -> str | None:
    if isinstance(value, dict):
        value = value.get("kind", value.get("preset"))
    if isinstance(value, list):
        texts = [_text(item) for item in value]
        return "_".join(text for text in texts if text) if texts and all(texts) else None
    if isinstance(value, bool) or value is None:
        return {True: "true", False: "false", None: "null"}[value]
    text = str(value).replace("+", "")
    return text if re.fullmatch(r"[A-Za-z0-9_.-]{1,40}", text) else None
