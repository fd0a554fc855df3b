"""What to say where a name is unknown."""

from __future__ import annotations

import difflib
from collections.abc import Collection

from regkit.model import did_you_mean

_MANY = 30
"""Of more names than this only the nearest are listed."""


def instead_of(name: str, known: Collection[str]) -> str:
    """The end of a message that ``name`` is unknown: what is known, or what of it is near."""
    names = list(known)
    if len(names) <= _MANY:
        return f"{did_you_mean(name, names)} (there are: {', '.join(names)})"
    near = difflib.get_close_matches(name, names, n=8, cutoff=0.3) or names[:8]
    return f"{did_you_mean(name, names)} (of {len(names)} the nearest are: {', '.join(near)})"
