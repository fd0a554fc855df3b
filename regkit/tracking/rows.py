"""Rows of numbers, one for each frame, in memory or in a file that grows with them."""

from __future__ import annotations

import json
import time
from abc import ABC, abstractmethod
from array import array
from collections.abc import Mapping
from math import prod
from pathlib import Path
from typing import Any

import numpy as np

from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.guard import reading

Layout = Mapping[str, tuple[int, ...]]
"""Shapes of the values of a row, by name, in the order of the row."""

Arrays = dict[str, Array]

WRITTEN_EVERY = 0.5
"""Time after which the rows that wait are written to a file [s]."""

LONGEST_HEAD = 1 << 20
"""Largest length of a file's first line."""


class Rows(ABC):
    """Rows of equal layout.

    Args:
        layout: Shapes of the values of a row.
    """

    def __init__(self, layout: Layout) -> None:
        self.layout = dict(layout)
        self._row = np.empty(width(layout))
        self._parts = _parts(self._row[None], layout)
        self._count = 0

    def __len__(self) -> int:
        """Number of rows."""
        return self._count

    def append(self, values: Mapping[str, Any]) -> None:
        """Appends a row.

        Args:
            values: Its values by name, as the layout names them.

        Raises:
            DataError: If it cannot be written.
        """
        for name, part in self._parts.items():
            part[0] = values[name]
        self._store(self._row.tobytes())
        self._count += 1

    def arrays(self) -> Arrays:
        """Returns the values of all N rows by name, each (N, ...)."""
        numbers = self._stored().reshape(self._count, width(self.layout))
        return _parts(numbers, self.layout)

    @abstractmethod
    def _store(self, row: bytes) -> None:
        """Keeps a row."""

    @abstractmethod
    def _stored(self) -> Array:
        """Returns the numbers of all rows, one after the other."""


class RowsInMemory(Rows):
    """Rows in memory."""

    def __init__(self, layout: Layout) -> None:
        super().__init__(layout)
        self._numbers = array("d")

    def _store(self, row: bytes) -> None:
        self._numbers.frombytes(row)

    def _stored(self) -> Array:
        return np.array(self._numbers)


class RowsInFile(Rows):
    """Rows in a file, so that memory does not grow and a killed process loses half a second.

    The first line is JSON with the layout and what ``about`` says; rows of doubles follow.

    Args:
        layout: Shapes of the values of a row.
        path: The file; an existing one is replaced.
        about: What else a reader must know, as JSON.

    Raises:
        DataError: If the file cannot be written.
    """

    def __init__(self, layout: Layout, path: Path, about: Mapping[str, Any]) -> None:
        super().__init__(layout)
        self._path = path
        self._waiting: list[bytes] = []
        self._written = time.monotonic()
        head = json.dumps(
            {"layout": {name: list(shape) for name, shape in layout.items()}, **about}
        )
        self._start = len(head.encode()) + 1
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(head.encode() + b"\n")
        except OSError as error:
            raise _unwritten(path, error) from None

    def flush(self) -> None:
        """Writes the rows that wait.

        Raises:
            DataError: If they cannot be written.
        """
        try:
            with self._path.open("ab") as stream:
                stream.write(b"".join(self._waiting))
        except OSError as error:
            raise _unwritten(self._path, error) from None
        self._waiting.clear()
        self._written = time.monotonic()

    def _store(self, row: bytes) -> None:
        self._waiting.append(row)
        if time.monotonic() - self._written >= WRITTEN_EVERY:
            self.flush()

    def _stored(self) -> Array:
        self.flush()
        return np.fromfile(self._path, dtype=np.float64, offset=self._start)


def read_rows(path: Path, what: str) -> tuple[Arrays, dict[str, Any]]:
    """Returns the rows of a file, without the last one if it is cut short, and what it says.

    Args:
        path: The file.
        what: What the file is, for messages.

    Raises:
        DataError: If it is missing or damaged.
    """
    with reading(path, what), path.open("rb") as stream:
        head = stream.readline(LONGEST_HEAD)
        about = json.loads(head)
        layout = {name: tuple(map(int, shape)) for name, shape in about.pop("layout").items()}
        numbers = np.frombuffer(stream.read(), dtype=np.uint8)
        whole = len(numbers) // (8 * width(layout)) * 8 * width(layout)
        rows = numbers[:whole].view(np.float64).reshape(-1, width(layout))
        return _parts(rows, layout), about


def width(layout: Layout) -> int:
    """Returns the number of doubles in a row."""
    return sum(prod(shape) for shape in layout.values())


def _parts(rows: Array, layout: Layout) -> Arrays:
    """Returns views of the values in rows (N, width), each (N, ...)."""
    parts, at = {}, 0
    for name, shape in layout.items():
        end = at + prod(shape)
        parts[name] = rows[:, at:end].reshape(len(rows), *shape)
        at = end
    return parts


def _unwritten(path: Path, error: OSError) -> DataError:
    return DataError(f"cannot be written: {error.strerror or error}", place=str(path))
