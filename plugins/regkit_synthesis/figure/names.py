"""Names of joints and bones: which of them is meant, and what to say where none is."""

from __future__ import annotations

import difflib
from collections.abc import Collection

from regkit.config.model import did_you_mean

_MANY = 30
"""Of more names than this only the nearest are listed."""


def meant(wanted: str, known: Collection[str]) -> str | None:
    """The name among ``known`` that is meant by ``wanted``, if there is one.

    A name without a namespace (``mixamorig:``) is found in any.
    """
    if wanted in known:
        return wanted
    if ":" in wanted:
        return None
    return next((name for name in known if name.rpartition(":")[2] == wanted), None)


def instead_of(name: str, known: Collection[str]) -> str:
    """The end of a message that ``name`` is unknown: what is known, or what of it is near."""
    names = list(known)
    if len(names) <= _MANY:
        return f"{did_you_mean(name, names)} (there are: {', '.join(names)})"
    near = difflib.get_close_matches(name, names, n=8, cutoff=0.3) or names[:8]
    return f"{did_you_mean(name, names)} (of {len(names)} the nearest are: {', '.join(near)})"
