"""Names of a sweep's experiments and methods: short, readable, and valid as folders."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

LONGEST = 80
"""Maximum length of a name; longer ones are replaced by numbers to keep paths short."""


def variants(head: str, values: Mapping[tuple[str, ...], Sequence[Any]]) -> list[str]:
    """Returns the names of all combinations of values, the last field varying fastest.

    Args:
        head: Prefix of every name, such as a method's name; may be empty.
        values: Lists by the path to the field, which is empty if the whole value is swept.
    """
    names = [head] if head else [""]
    for way, texts in zip(_shortest(list(values)), map(_texts, values.values()), strict=True):
        names = [",".join(filter(None, (name, f"{way}={text}" if way else text)))
                 for name in names for text in texts]  # fmt: skip
    if max(map(len, names)) <= LONGEST:
        return names
    return [f"{head or 'setting'},{number:03d}" for number in range(1, len(names) + 1)]


def _shortest(ways: list[tuple[str, ...]]) -> list[str]:
    """Returns the shortest unique suffixes of the paths, such as ``sigma`` of ``kernel.sigma``."""
    ends = []
    for way in ways:
        others = [other for other in ways if other != way]
        length = 1
        # The index of an item alone would be meaningless.
        while length < len(way) and (
            way[-length].isdecimal() or any(other[-length:] == way[-length:] for other in others)
        ):
            length += 1
        ends.append(re.sub(r"[^A-Za-z0-9_.-]", "_", ".".join(way[-length:])))
    if len(set(ends)) < len(ends):
        return [f"{end}.{number}" for number, end in enumerate(ends, 1)]
    return ends


def _texts(values: Sequence[Any]) -> list[str]:
    """Returns a text for each value: its index in the list if it has no short form."""
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
