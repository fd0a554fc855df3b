"""The values of a PLY file, element by element."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from regkit.clouds.formats.ply.header import Element, Header, Property
from regkit.system.errors import DataError
from regkit.system.plain_numbers import real, whole
from regkit.system.printable import shortened

Column = np.ndarray[Any, Any] | list[np.ndarray[Any, Any]]
"""The values (N,) of a property; of a list (N, n), or N arrays if their lengths differ."""


@dataclass
class TextValues:
    """The values of a text file, one row per line.

    Attributes:
        rows: Line numbers and words of the lines that are not empty.
        place: The file, for messages.
        at: Number of rows read so far.
    """

    rows: list[tuple[int, list[str]]]
    place: str
    at: int = 0

    @classmethod
    def of(cls, content: bytes, header: Header, place: str) -> TextValues:
        """Returns the values below the header."""
        lines = content[header.size :].decode("latin-1").replace("\r", "").split("\n")
        words = ((number, line.split()) for number, line in enumerate(lines, header.lines + 1))
        return cls([(number, row) for number, row in words if row], place)

    def read(self, element: Element) -> dict[str, Column]:
        """Returns the columns of an element.

        Raises:
            DataError: If rows are missing or invalid.
        """
        left = len(self.rows) - self.at
        if left < element.rows:
            raise _cut_short(element, left, self.place)
        columns: dict[str, list[Any]] = {one.name: [] for one in element.properties}
        for number, words in self.rows[self.at : self.at + element.rows]:
            try:
                self._row(element.properties, words, columns)
            except (ValueError, OverflowError, IndexError):
                raise DataError(
                    f"not a row of element {element.name}: '{shortened(' '.join(words))}'",
                    place=f"{self.place}:{number}",
                ) from None
        self.at += element.rows
        return {
            one.name: columns[one.name]
            if one.count
            else np.array(columns[one.name], dtype=np.float64)
            for one in element.properties
        }

    @staticmethod
    def _row(properties: list[Property], words: list[str], columns: dict[str, list[Any]]) -> None:
        at = 0
        for one in properties:
            if one.count is None:
                columns[one.name].append(real(words[at]))
                at += 1
                continue
            end = at + 1 + whole(words[at])
            read = whole if one.kind[0] in "iu" else real
            values = [read(word) for word in words[at + 1 : end]]
            columns[one.name].append(np.array(values))
            at = end
        if at != len(words):
            raise ValueError

    def check_end(self) -> None:
        """Raises DataError if rows are left that no element announces."""
        if self.at < len(self.rows):
            raise DataError(
                f"{len(self.rows) - self.at} lines more than the header announces",
                place=f"{self.place}:{self.rows[self.at][0]}",
            )


@dataclass
class BinaryValues:
    """The values of a binary file.

    Attributes:
        content: The content of the file.
        order: NumPy's byte order.
        place: The file, for messages.
        at: Number of bytes read so far.
    """

    content: bytes
    order: str
    place: str
    at: int

    def read(self, element: Element) -> dict[str, Column]:
        """Returns the columns of an element.

        Raises:
            DataError: If bytes are missing.
        """
        lists = [one for one in element.properties if one.count]
        if not lists:
            rows = self._rows(element, {})
            return {one.name: rows[one.name] for one in element.properties}
        counts = self._first_counts(element) if element.rows else {}
        try:
            rows = self._rows(element, counts)
        except DataError:
            return self._one_by_one(element)
        # Nearly all meshes have faces of one number of corners; others are read one by one.
        if any((rows[f"{one.name} count"] != counts[one.name]).any() for one in lists):
            self.at -= rows.nbytes
            return self._one_by_one(element)
        return {one.name: rows[one.name] for one in element.properties}

    def _rows(self, element: Element, counts: dict[str, int]) -> np.ndarray[Any, Any]:
        fields: list[tuple[Any, ...]] = []
        for one in element.properties:
            if one.count is None:
                fields.append((one.name, self.order + one.kind))
                continue
            fields.append((f"{one.name} count", self.order + one.count))
            fields.append((one.name, self.order + one.kind, (counts.get(one.name, 0),)))
        dtype = np.dtype(fields)
        left = len(self.content) - self.at
        if element.rows * dtype.itemsize > left:
            held = left // max(1, dtype.itemsize)
            raise _cut_short(element, held, self.place)
        rows = np.frombuffer(self.content, dtype, element.rows, self.at)
        self.at += rows.nbytes
        return rows

    def _first_counts(self, element: Element) -> dict[str, int]:
        at = self.at
        row = self._one_by_one(Element(element.name, 1, element.properties))
        self.at = at
        return {one.name: len(row[one.name][0]) for one in element.properties if one.count}

    def _one_by_one(self, element: Element) -> dict[str, Column]:
        columns: dict[str, list[Any]] = {one.name: [] for one in element.properties}
        for row in range(element.rows):
            for one in element.properties:
                count = 1 if one.count is None else int(self._values(one.count, 1, element, row)[0])
                values = self._values(one.kind, count, element, row)
                columns[one.name].append(values if one.count else values[0])
        return {
            one.name: columns[one.name] if one.count else np.array(columns[one.name])
            for one in element.properties
        }

    def _values(self, kind: str, count: int, element: Element, row: int) -> np.ndarray[Any, Any]:
        dtype = np.dtype(self.order + kind)
        if count < 0 or count * dtype.itemsize > len(self.content) - self.at:
            raise _cut_short(element, row, self.place)
        values = np.frombuffer(self.content, dtype, count, self.at)
        self.at += values.nbytes
        return values

    def check_end(self) -> None:
        """Raises DataError if bytes are left that no element announces."""
        left = self.content[self.at :]
        if left.strip(b"\r\n \0"):
            raise DataError(
                f"{len(left)} bytes more than the header announces; the file is damaged",
                place=self.place,
            )


def _cut_short(element: Element, held: int, place: str) -> DataError:
    return DataError(
        f"announces {element.rows} rows of element {element.name}, but holds {held}; the file is "
        "cut short or damaged",
        place=place,
    )
