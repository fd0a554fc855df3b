"""Matching of joint and bone names, and messages about unknown ones."""

from __future__ import annotations

import difflib
from collections.abc import Collection

from regkit.config.model import did_you_mean

_MANY = 30
"""Maximum number of names in a message; of more only the most similar are listed."""


def meant(wanted: str, known: Collection[str]) -> str | None:
    """Returns the name in ``known`` that matches ``wanted``, or None.

    A name without a namespace (``mixamorig:``) matches in any namespace.
    """
    if wanted in known:
        return wanted
    if ":" in wanted:
        return None
    return next((name for name in known if name.rpartition(":")[2] == wanted), None)


def instead_of(name: str, known: Collection[str]) -> str:
    """Returns the end of a message about an unknown ``name``: all or similar known names."""
    names = list(known)
    if len(names) <= _MANY:
        return f"{did_you_mean(name, names)} (there are: {', '.join(names)})"
    near = difflib.get_close_matches(name, names, n=8, cutoff=0.3) or names[:8]
    return f"{did_you_mean(name, names)} (of {len(names)} the nearest are: {', '.join(near)})"
