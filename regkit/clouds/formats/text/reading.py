"""Reading of clouds from text files: rows of numbers, with or without a header."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

from regkit.clouds.formats.text.ambiguity import check_unnamed
from regkit.clouds.formats.text.columns import METRES, unit_stated
from regkit.clouds.formats.text.delimiter import Delimiter, delimiter_of
from regkit.clouds.formats.text.header import named_columns
from regkit.clouds.formats.text.lines import lines_of
from regkit.clouds.formats.text.numbers import Coordinates
from regkit.clouds.formats.text.numpy_rows import plain_rows
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.notes import note
from regkit.system.printable import shortened

ORDERED = (".xyz", ".xyzn", ".xyzrgb", ".pts", ".asc")
"""Formats without a header, whose columns begin with x y z by definition."""

SEARCHED = 1000
"""Number of lines among which the first row of numbers must be."""

_COMMENT = re.compile(r"(#|//|%)+\s*")
_SEPARATOR = re.compile(r'"?sep=(.|\\t)"?', re.IGNORECASE)


@dataclass
class _Content:
    """The lines of a file by their kinds; a line is its number and its text."""

    comments: list[tuple[int, str]] = field(default_factory=list)
    counts: list[tuple[int, int]] = field(default_factory=list)
    rows: list[tuple[int, str]] = field(default_factory=list)
    separator: str | None = None


def read_text(path: Path) -> Array:
    """Returns the points (N, 3) of a text file; missing measurements are NaN.

    Columns are found by the names in the header, a line of text or a comment above the numbers.
    Without one the first three are x, y and z. Delimiter and decimal sign are the same in the whole
    file. A line with one whole number announces the number of rows that follow.

    Raises:
        DataError: If a line does not fit, or can be read in two ways.
    """
    content = _sorted(lines_of(path))
    texts = [line for _, line in content.rows[:SEARCHED]]
    found = delimiter_of(texts, content.separator)
    if found is None:
        # The first line may be the header.
        number, line = content.rows[:2][-1] if texts else (1, "")
        raise DataError(
            "the file contains no points: no line holds three numbers, such as "
            f"'{shortened(line)}'",
            place=f"{path}:{number}",
        )
    delimiter, first = found
    above, rows = content.rows[:first], content.rows[first:]
    width = len(delimiter.cells(rows[0][1]))
    columns = named_columns(path, above, content.comments, delimiter, rows[0])
    heads = {line for _, line in above}
    repeated = [number for number, line in rows if line in heads]
    if repeated:
        note(f"the header is repeated {len(repeated)} times", place=f"{path}:{repeated[0]}")
        rows = [(number, line) for number, line in rows if line not in heads]
    _check_counts(path, content.counts, rows)
    points = _points(path, rows, delimiter, width, columns.indices if columns else (0, 1, 2))
    if columns is None:
        check_unnamed(rows, delimiter, str(path), points)
        if width > 3 and path.suffix.lower() not in ORDERED:
            note(f"no header: the first three of {width} columns are x, y and z", place=path)
    unit = columns.unit if columns else ""
    unit = unit or unit_stated([line for _, line in content.comments])
    if unit not in ("", "m"):
        note(f"the header names the unit {unit}; converted to metres", place=path)
    return points * METRES[unit or "m"]


def _points(
    path: Path,
    rows: list[tuple[int, str]],
    delimiter: Delimiter,
    width: int,
    indices: tuple[int, int, int],
) -> Array:
    plain = plain_rows([line for _, line in rows], delimiter, width, indices)
    if plain is not None:
        return plain
    coordinates = Coordinates(str(path))
    x, y, z = indices
    for number, line in rows:
        cells = delimiter.cells(line)
        if len(cells) != width:
            raise DataError(
                f"{len(cells)} cells, separated by {delimiter}, where line {rows[0][0]} has "
                f"{width}: '{shortened(line)}'",
                place=f"{path}:{number}",
            )
        coordinates.add((cells[x], cells[y], cells[z]), number)
    return coordinates.points()


def _sorted(lines: list[str]) -> _Content:
    content = _Content()
    for number, raw in enumerate(lines, start=1):
        line = raw.strip(" \r\n\f\v")
        bare = line.strip()
        if not bare:
            continue
        comment = _COMMENT.match(bare) if bare[0] in "#/%" else None
        separator = None if content.rows else _SEPARATOR.fullmatch(bare)
        if separator is not None:
            content.separator = separator[1].replace("\\t", "\t")
        elif comment is not None:
            if not content.rows:
                content.comments.append((number, bare[comment.end() :]))
        elif bare.isascii() and bare.isdigit():
            content.counts.append((number, int(bare[:18])))
        else:
            content.rows.append((number, line))
    return content


def _check_counts(path: Path, counts: list[tuple[int, int]], rows: list[tuple[int, str]]) -> None:
    """Checks the number of rows that follow each line with a count."""
    if counts and counts[0][0] > rows[0][0]:
        raise DataError("a lone number among rows", place=f"{path}:{counts[0][0]}")
    ends = [number for number, _ in counts[1:]] + [rows[-1][0] + 1] * bool(counts)
    for (number, count), end in zip(counts, ends, strict=True):
        follow = sum(number < at < end for at, _ in rows)
        if follow != count:
            raise DataError(
                f"announces {count} points, but {follow} rows follow; the file is cut short, or "
                "a line is not of this format",
                place=f"{path}:{number}",
            )
