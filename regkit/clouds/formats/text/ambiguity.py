"""Rows without a header that can be read in two ways."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from regkit.clouds.formats.text.delimiter import Delimiter
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.printable import shortened

_PAIRS = {
    ",": (
        (r"[-+]?\d+,\s*\d+(,\s*[-+]?\d+,\s*\d+){2,}", "1,5"),
        (r"[-+]?\d{1,3},\d{3}(\.\d*)?(,\s*[-+]?\d{1,3},\d{3}(\.\d*)?){2,}", "1,234.5"),
    ),
    None: ((r"[-+]?\d{1,3} \d{3}([.,]\d*)?(\s+[-+]?\d{1,3} \d{3}([.,]\d*)?){2,}", "1 234.5"),),
}
"""Rows in which a delimiter may stand within numbers as well as between them."""

WIDEST = 64
"""Number of cells of a row without a header that no point has."""

FEW = 10
"""Number of rows below which consecutive numbers in the first column may be chance."""


def check_unnamed(
    rows: Sequence[tuple[int, str]],
    delimiter: Delimiter,
    path: str,
    points: Array,
) -> None:
    """Refuses rows without a header whose first three columns may not be x, y and z.

    Args:
        rows: Line numbers and lines, at least one.
        delimiter: The delimiter.
        path: The file, for messages.
        points: The first three columns, (N, 3).

    Raises:
        DataError: If numbers may be cut in two, a row is too long, the first row numbers the
            columns, or the first column numbers the rows.
    """
    number, first = rows[0]
    place = f"{path}:{number}"
    for pattern, example in _PAIRS.get(delimiter.sign, ()):
        fits = re.compile(pattern).fullmatch
        if fits(first) and all(fits(line) for _, line in rows):
            raise DataError(
                f"every row may hold half as many numbers, like {example}; name the columns in a "
                "header, or separate them by semicolons",
                place=place,
            )
    cells = delimiter.cells(first)
    if len(cells) > WIDEST:
        raise DataError(
            f"a row of {len(cells)} numbers and no header; a point has at most {WIDEST}: the line "
            "ends are missing, or this is no cloud",
            place=place,
        )
    counted = [cell for cell in cells if cell]
    if counted == [str(n) for n in range(len(counted))] and (points[1:] % 1.0).any():
        raise DataError(
            f"'{shortened(first)}' looks like numbers of the columns, not like a point; name the "
            "columns x, y and z",
            place=place,
        )
    counts = points[:, 0]
    steps = len(counts) > FEW and counts[0] in (0.0, 1.0) and (np.diff(counts) == 1.0).all()
    if len(cells) > 3 and steps:
        raise DataError(
            "the first column numbers the rows; name the columns x, y and z in a header",
            place=place,
        )
