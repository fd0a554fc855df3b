"""The header of a text file: the line above the rows that names their columns."""

from __future__ import annotations

import re
from pathlib import Path

from regkit.clouds.formats.text.columns import Columns, are_units, columns_named
from regkit.clouds.formats.text.delimiter import Delimiter
from regkit.system.errors import DataError
from regkit.system.notes import note
from regkit.system.printable import shortened

_LABEL = re.compile(r"^\w+:\s+")
"""A word before the names in a comment, such as ``columns:``."""


def named_columns(
    path: Path,
    above: list[tuple[int, str]],
    comments: list[tuple[int, str]],
    delimiter: Delimiter,
    row: tuple[int, str],
) -> Columns | None:
    """Returns the columns that a header names; None without a header.

    Args:
        path: The file, for messages.
        above: Lines of text above the rows, and their numbers.
        comments: Comments above the rows, and their numbers.
        delimiter: What separates the cells of the rows.
        row: The first row, and its number.

    Raises:
        DataError: If the header names no x, y and z, or other columns than there are.
    """
    first, cells = row[0], delimiter.cells(row[1])
    width, units = len(cells), None
    if len(above) > 1 and are_units(delimiter.cells(above[-1][1])):
        units = delimiter.cells(above[-1][1])
        above = above[:-1]
    for number, line in [*above[-1:], *reversed(comments)]:
        place = f"{path}:{number}"
        try:
            named = [
                (names, columns)
                for names in _names(line, delimiter, cells)
                if (columns := columns_named(names, units)) is not None
            ]
        except ValueError as error:
            raise DataError(str(error), place=place) from None
        for names, columns in named:
            if len(names) == width:
                _tell_passed(path, [at for at, _ in above if at < number])
                return columns
        # Comments often name the first columns only; three columns are x, y and z in any case.
        certain = width == 3 or all(columns.indices == (0, 1, 2) for _, columns in named)
        if named and not ((number, line) in comments and certain):
            raise DataError(
                f"the header names {len(named[0][0])} columns, but line {first} has {width}, "
                f"separated by {delimiter}",
                place=place,
            )
    if above:
        number, line = above[-1]
        shown = ", ".join(delimiter.cells(line))
        raise DataError(
            f"the header names no x, y and z; it names: {shortened(shown, 200)}",
            place=f"{path}:{number}",
        )
    return None


def _names(line: str, delimiter: Delimiter, row: list[str]) -> list[list[str]]:
    """Returns the readings of a header: by the delimiter of the rows, or by any.

    A trailing delimiter in the rows or the header adds an empty cell.
    """
    # The brackets of a unit belong to the name before them.
    line = re.sub(r"\s+(?=[\[(])", "", line)
    own = delimiter.cells(line)
    if len(own) == len(row) - 1 and not row[-1]:
        own = [*own, ""]
    elif len(own) == len(row) + 1 and not own[-1]:
        own = own[:-1]
    line = _LABEL.sub("", line)
    loose = [name for name in re.split(r"[\s,;|]+", line.strip()) if name]
    return [own, loose]


def _tell_passed(path: Path, numbers: list[int]) -> None:
    if numbers:
        note(f"{len(numbers)} lines above the header are passed over", place=f"{path}:{numbers[0]}")
