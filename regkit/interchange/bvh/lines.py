"""The lines of a BVH file, each with its place for messages."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from regkit.system.errors import DataError


class Lines:
    """The lines of a text that say something, read one after the other, each with its place."""

    def __init__(self, path: Path, text: str) -> None:
        self.path = path
        self._statements = list(_statements(text))
        self._next = 0

    def take(self, wanted: str) -> str:
        """The next line.

        Raises:
            DataError: If the file ends here; ``wanted`` should have followed.
        """
        if self._next == len(self._statements):
            raise DataError(f"the file ends where {wanted} should follow", place=self.place)
        self._next += 1
        return self._statements[self._next - 1][1]

    def rest(self) -> Iterator[str]:
        """All lines that are left."""
        while self._next < len(self._statements):
            yield self.take("another line")

    def field(self, name: str) -> float:
        """The number after ``name:`` in the next line.

        Raises:
            DataError: If something else stands there.
        """
        line = self.take(f"{name}:")
        word, colon, number = line.partition(":")
        if not colon or word.strip().lower() != name.lower():
            raise self.wrong(f"'{line[:40]}' where {name}: should stand")
        return self.numbers(number, 1, name)[0]

    @property
    def place(self) -> str:
        """Where the line taken last stands."""
        return f"{self.path}:{self._statements[self._next - 1][0] if self._next else 1}"

    def wrong(self, message: str) -> DataError:
        """An error at the line taken last."""
        return DataError(message, place=self.place)

    def numbers(self, text: str, count: int, what: str) -> list[float]:
        """The ``count`` numbers of a text.

        Raises:
            DataError: If there are fewer or more, or one is no finite number.
        """
        words = text.split()
        if len(words) != count:
            raise self.wrong(f"{what} has {len(words)} numbers; it needs {count}")
        try:
            values = list(map(float, words))
        except ValueError as error:
            raise self.wrong(f"{what} has a word that is no number ({error})") from None
        if not np.isfinite(values).all():
            bad = next(word for word, value in zip(words, values, strict=True) if value - value)
            raise self.wrong(f"{what} holds {bad}; all numbers must be finite")
        return values


def _statements(text: str) -> Iterator[tuple[int, str]]:
    """Lines with their numbers; a brace is a line of its own, wherever it stands."""
    for number, line in enumerate(text.splitlines(), start=1):
        pieces = re.split(r"([{}])", line) if "{" in line or "}" in line else [line]
        for piece in pieces:
            if piece.strip():
                yield number, piece.strip()
