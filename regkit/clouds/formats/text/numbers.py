"""Coordinates of a text file, all with one decimal sign."""

from __future__ import annotations

import re
from array import array

import numpy as np

from regkit.clouds.formats.text.delimiter import is_missing, is_number
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.printable import shortened

_THOUSANDS = re.compile(r"[-+]?[1-9]\d{0,2},\d{3}", re.ASCII)
"""A cell such as 1,234: with a decimal comma 1.234, with a thousands separator 1234."""


class Coordinates:
    """The coordinates of a file, added row by row.

    Args:
        path: The file, for messages.
    """

    def __init__(self, path: str) -> None:
        self._path = path
        self._values = array("d")
        self._comma: int | None = None
        self._point: int | None = None
        self._grouped: int | None = None
        self._certain = False

    def add(self, cells: tuple[str, str, str], number: int) -> None:
        """Adds the cells of x, y and z on line ``number``.

        Raises:
            DataError: If a cell is not a number.
        """
        x, y, z = cells
        if self._point is None and ("." in x or "." in y or "." in z):
            self._point = number
        try:
            row = (float(x), float(y), float(z))
        except ValueError:
            row = None
        # NaN, infinity, and what only Python reads as a number need a second look.
        text = x + y + z
        odd = "_" in text or not text.isascii()
        if row is None or odd or not abs(row[0] + row[1] + row[2]) < np.inf:
            row = self._second_look(cells, number)
        self._values.extend(row)

    def _second_look(self, cells: tuple[str, str, str], number: int) -> tuple[float, float, float]:
        x, y, z = (
            self._number(cell, axis, number) for cell, axis in zip(cells, "xyz", strict=True)
        )
        return x, y, z

    def _number(self, cell: str, axis: str, number: int) -> float:
        if is_missing(cell):
            return np.nan
        place = f"{self._path}:{number}"
        if not is_number(cell):
            raise DataError(f"{axis} is '{shortened(cell)}', which is not a number", place=place)
        if "," in cell:
            self._comma = self._comma or number
            if _THOUSANDS.fullmatch(cell):
                self._grouped = self._grouped or number
            else:
                self._certain = True
        # Fortran writes 1.5D+02.
        plain = cell.replace(",", ".").replace("\u2212", "-").upper().replace("D", "E")
        value = float(plain)
        if np.isinf(value):
            raise DataError(f"{axis} is '{shortened(cell)}', beyond any number", place=place)
        return value

    def points(self) -> Array:
        """Returns all rows, (N, 3); missing measurements are NaN.

        Raises:
            DataError: If the decimal sign changes within the file, or is uncertain.
        """
        if self._comma is not None and self._point is not None:
            raise DataError(
                f"numbers with a decimal comma here, but with a decimal point in line "
                f"{self._point}; write all with a point",
                place=f"{self._path}:{self._comma}",
            )
        if self._grouped is not None and not self._certain:
            raise DataError(
                "'1,234' may be 1.234 or 1234: every comma of the file is followed by three "
                "digits; write the numbers with a decimal point",
                place=f"{self._path}:{self._grouped}",
            )
        return np.frombuffer(self._values, dtype=np.float64).reshape(-1, 3).copy()
