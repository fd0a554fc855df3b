"""The lines of a BVH file, with line numbers for error messages."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from regkit.system.errors import DataError


class Lines:
    """The non-empty lines of a text, read one after the other.

    Args:
        path: The file, for error messages.
        text: Its content.
    """

    def __init__(self, path: Path, text: str) -> None:
        self.path = path
        self._statements = list(_statements(text))
        self._next = 0

    def take(self, wanted: str) -> str:
        """Returns the next line.

        Raises:
            DataError: If the file ends here; the message names ``wanted``.
        """
        if self._next == len(self._statements):
            raise DataError(f"the file ends where {wanted} is expected", place=self.place)
        self._next += 1
        return self._statements[self._next - 1][1]

    def rest(self) -> Iterator[str]:
        """Yields all remaining lines."""
        while self._next < len(self._statements):
            yield self.take("another line")

    def field(self, name: str) -> float:
        """Returns the number after ``name:`` in the next line.

        Raises:
            DataError: If the line is something else.
        """
        line = self.take(f"{name}:")
        word, colon, number = line.partition(":")
        if not colon or word.strip().lower() != name.lower():
            raise self.wrong(f"'{line[:40]}' where {name}: is expected")
        return self.numbers(number, 1, name)[0]

    @property
    def place(self) -> str:
        """``file:line`` of the line taken last."""
        return f"{self.path}:{self._statements[self._next - 1][0] if self._next else 1}"

    def wrong(self, message: str) -> DataError:
        """Returns an error at the line taken last."""
        return DataError(message, place=self.place)

    def numbers(self, text: str, count: int, what: str) -> list[float]:
        """Returns the ``count`` numbers of a text; ``what`` names them in messages.

        Raises:
            DataError: If their count differs, or one is not a finite number.
        """
        words = text.split()
        if len(words) != count:
            raise self.wrong(f"{what} has {len(words)} numbers; it needs {count}")
        try:
            values = list(map(float, words))
        except ValueError as error:
            raise self.wrong(f"{what} has a word that is not a number ({error})") from None
        if not np.isfinite(values).all():
            bad = next(word for word, value in zip(words, values, strict=True) if value - value)
            raise self.wrong(f"{what} holds {bad}; all numbers must be finite")
        return values


def _statements(text: str) -> Iterator[tuple[int, str]]:
    """Yields the statements of a text with their line numbers; a brace is a statement."""
    for number, line in enumerate(text.splitlines(), start=1):
        pieces = re.split(r"([{}])", line) if "{" in line or "}" in line else [line]
        for piece in pieces:
            if piece.strip():
                yield number, piece.strip()
