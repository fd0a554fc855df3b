"""The lines of a BVH file, with line numbers for error messages."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from regkit.system.errors import DataError
from regkit.system.plain_numbers import real

HUGE = 1e30
"""Larger numbers are no lengths or angles, and their products overflow."""


class Lines:
    """The statements of a text, by and large its lines, read one after the other.

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
        if self.ended:
            raise DataError(f"the file ends where {wanted} is expected", place=self.place)
        self._next += 1
        return self._statements[self._next - 1][1]

    def ahead(self) -> str:
        """Returns the next line without taking it; empty at the end of the file."""
        return "" if self.ended else self._statements[self._next][1]

    @property
    def ended(self) -> bool:
        """Whether all lines are taken."""
        return self._next == len(self._statements)

    def field(self, name: str) -> float | None:
        """Returns the number after ``name:`` in the next line; None if it is another line.

        Raises:
            DataError: If no number follows.
        """
        pattern = r"\s*".join(name.split()) + r"\s*:?(.*)"
        found = re.fullmatch(pattern, self.ahead(), re.IGNORECASE)
        if found is None:
            return None
        self.take(name)
        return self.numbers(found.group(1), 1, name)[0]

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
            values = list(map(real, words))
        except ValueError:
            values = self._with_commas(words, what)
        if not np.isfinite(values).all():
            bad = next(word for word, value in zip(words, values, strict=True) if value - value)
            raise self.wrong(f"{what} holds {bad}; all numbers must be finite")
        if np.abs(values).max(initial=0.0) > HUGE:
            raise self.wrong(f"{what} holds {max(values, key=abs):g}, which cannot be right")
        return values

    def _with_commas(self, words: list[str], what: str) -> list[float]:
        """Returns numbers with decimal commas."""
        try:
            return [real(word.replace(",", ".")) for word in words]
        except ValueError as error:
            raise self.wrong(f"{what} has a word that is not a number ({error})") from None


_LINE_ENDS = re.compile(r"\r\n|\r|\n")
_OPENING = ("HIERARCHY", "OFFSET", "CHANNELS", "MOTION", "FRAMES")
_INLINE = re.compile(
    r"\s+(?=(?:ROOT|OFFSET|CHANNELS|JOINT|End\s+Site|Frames|Frame\s+Time)\b)", re.IGNORECASE
)


def _statements(text: str) -> Iterator[tuple[int, str]]:
    """Yields the statements of a text with their line numbers; a brace is a statement."""
    for number, line in enumerate(_LINE_ENDS.split(text), start=1):
        for piece in re.split(r"([{}])", line) if "{" in line or "}" in line else [line]:
            statement = piece.strip()
            if statement[:9].upper().startswith(_OPENING):
                yield from ((number, one) for one in _INLINE.split(statement))
            elif statement:
                yield number, statement
