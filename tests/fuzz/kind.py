"""A kind of input: sound files, the entrance that reads them, and what may come of it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

Files = Mapping[str, bytes]
"""Contents by path from the folder of a case."""


@dataclass(frozen=True)
class Damaged:
    """What an oracle knows of the file that was read.

    Attributes:
        sound: All files, undamaged.
        content: The damaged content.
        noted: Whether the reader told that it passed over, assumed or repaired something.
    """

    sound: Files
    content: bytes
    noted: bool


Oracle = Callable[[Any, Damaged], Iterable[str]]
"""Yields in what a value that was read without an error is nonsense."""


@dataclass(frozen=True)
class Kind:
    """A kind of input.

    Attributes:
        name: Its name, ``ROOM/KIND``.
        seeds: Returns sound files, in one or several variants; it is called once per process.
        forms: The files that may be damaged, and the form of each.
        read: The entrance.
        nonsense: The oracle.
        whole: Whether the entrance reads the folder, and not the damaged file.
        suffixes: Suffixes that the damaged file may get instead of its own.
        weight: How often it is drawn, compared with others.
    """

    name: str
    seeds: Callable[[], list[Files]]
    forms: Mapping[str, str]
    read: Callable[[Path], Any]
    nonsense: Oracle
    whole: bool = False
    suffixes: tuple[str, ...] = ()
    weight: float = 1.0
