"""The files that code opens, as Python sees them."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

_LISTS: list[set[Path]] = []


@contextmanager
def opened_files() -> Iterator[set[Path]]:
    """Context manager: yields a set that grows with each file that is opened.

    Files that libraries open in native code are not seen.
    """
    _listen()
    found: set[Path] = set()
    _LISTS.append(found)
    try:
        yield found
    finally:
        _LISTS.remove(found)


@cache
def _listen() -> None:
    # A hook cannot be removed; without lists it does nothing.
    sys.addaudithook(_heard)


def _heard(event: str, arguments: tuple[Any, ...]) -> None:
    if _LISTS and event == "open" and isinstance(arguments[0], str | os.PathLike):
        for found in _LISTS:
            found.add(Path(os.fspath(arguments[0])).absolute())
