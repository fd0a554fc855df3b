"""The delimiter of a text file's cells."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass

DELIMITERS = ("\t", ";", ",", "|", None)
"""Delimiters in the order in which they are tried; None is any white space."""

MISSING = frozenset({
    "", "nan", "na", "n/a", "#n/a", "null", "none", "inf", "infinity",
    "nan(ind)", "1.#qnan", "1.#ind", "1.#inf",
})  # fmt: skip
"""Cells without sign that stand for a missing measurement, in small letters."""

_REMARK = re.compile(r"(^|\s)#.*")
_NUMBER = re.compile(r"[-+\u2212]?(\d+(\.\d*)?|\d*[.,]\d+)([eEdD][-+]?\d+)?", re.ASCII)


@dataclass(frozen=True)
class Delimiter:
    """What separates cells.

    Attributes:
        sign: The delimiter; None for any white space.
    """

    sign: str | None

    def cells(self, line: str) -> list[str]:
        """Returns the cells of a line, without quotes and surrounding spaces."""
        if '"' in line:
            reader = csv.reader([line], delimiter=self.sign or " ", skipinitialspace=True)
            return [cell.strip() for cell in next(reader)]
        if self.sign is None:
            bare = _REMARK.sub("", line) if "#" in line else line
            # A no-break space groups thousands; it separates no cells.
            return bare.split() if bare.isascii() else re.split("[ \t]+", bare.strip())
        return [cell.strip() for cell in line.split(self.sign)]

    def width(self, line: str) -> int | None:
        """Returns the number of cells if at least three are numbers, or None."""
        cells = self.cells(line)
        numbers = sum(is_number(cell) or (cell != "" and is_missing(cell)) for cell in cells)
        return len(cells) if numbers >= 3 else None

    def __str__(self) -> str:
        """Returns the name for messages."""
        return {"\t": "tabs", None: "white space"}.get(self.sign, f"'{self.sign}'")


def is_number(cell: str) -> bool:
    """Returns whether a cell is a number with a decimal point or a decimal comma."""
    return _NUMBER.fullmatch(cell) is not None


def is_missing(cell: str) -> bool:
    """Returns whether a cell stands for a missing measurement."""
    return cell.lstrip("-+").lower() in MISSING


def delimiter_of(lines: Sequence[str], given: str | None = None) -> tuple[Delimiter, int] | None:
    """Returns the delimiter of a file, and the index of its first line of numbers.

    Args:
        lines: Lines that may hold cells, in order.
        given: The delimiter that the file names itself.
    """
    tried = [Delimiter(given)] if given else [Delimiter(sign) for sign in DELIMITERS]
    for first, line in enumerate(lines):
        fitting = [delimiter for delimiter in tried if delimiter.width(line) is not None]
        if not fitting:
            continue
        some = lines[first : first + 100]
        # A delimiter that fits the first line only by chance fails on the others.
        best = max(fitting, key=lambda one: _agreeing(one, some))
        return best, first
    return None


def _agreeing(delimiter: Delimiter, lines: Sequence[str]) -> int:
    """Returns how many lines have as many cells as the first."""
    widths = [delimiter.width(line) for line in lines]
    return sum(width == widths[0] for width in widths)
