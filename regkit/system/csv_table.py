"""Tables as CSV, safe to open in a spreadsheet."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TextIO

from regkit.system.files import replacing
from regkit.system.printable import one_line

CsvTable = tuple[Sequence[str], Iterable[Sequence[object]]]
"""Names of the columns, and rows."""

_FORMULA = re.compile("\\s*[=+\\-@\uff1d\uff0b\uff0d\uff20]")
"""The beginning of a cell that a spreadsheet would run."""

_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")


def csv_text(columns: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """Returns a table as CSV.

    A text that a spreadsheet would take for a formula, such as a joint called ``=1+1``, gets an
    apostrophe in front; control characters become escapes.
    """
    stream = io.StringIO()
    _write(stream, columns, rows)
    return stream.getvalue()


def write_csv(path: Path, columns: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    """Writes a table as CSV, row by row, and atomically.

    Raises:
        DataError: If it cannot be written.
    """
    with replacing(path) as temporary, temporary.open("w", encoding="utf-8", newline="") as stream:
        _write(stream, columns, rows)


def _write(stream: TextIO, columns: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow([safe_cell(column) for column in columns])
    writer.writerows([safe_cell(value) for value in row] for row in rows)


def safe_cell(value: object) -> str:
    """Returns the text of a cell, without a formula and control characters."""
    text = one_line(str(value))
    return f"'{text}" if _FORMULA.match(text) and not _NUMBER.fullmatch(text) else text
