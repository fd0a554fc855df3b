"""PCL's point cloud format (PCD), of any field types.

Source: https://pointclouds.org/documentation/tutorials/pcd_file_format.html.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from regkit.clouds.formats.lzf import MAX_EXPANSION, decompress
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.plain_numbers import real
from regkit.system.printable import shortened

_KINDS = {"F": "f", "I": "i", "U": "u"}
_SIZES = {"F": (4, 8), "I": (1, 2, 4, 8), "U": (1, 2, 4, 8)}
_HEADER_BYTES = 1 << 16


@dataclass(frozen=True)
class _Header:
    """What a PCD file announces.

    Attributes:
        names: Names of the fields.
        fields: Type and number of values of each field.
        points: Number of points.
        data: ``ascii``, ``binary`` or ``binary_compressed``.
        lines: Number of lines of the header.
    """

    names: tuple[str, ...]
    fields: tuple[tuple[str, int], ...]
    points: int
    data: str
    lines: int

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of a point; fields are numbered, since names of padding repeat."""
        return np.dtype([(str(n), kind, (count,)) for n, (kind, count) in enumerate(self.fields)])

    @property
    def axes(self) -> list[int]:
        """Indices of the fields x, y and z."""
        return [self.names.index(axis) for axis in "xyz"]


def read_pcd(path: Path) -> Array:
    """Returns the points (N, 3) of a PCD file; missing measurements are NaN.

    Raises:
        DataError: If the header is invalid, or announces more or less than the file holds.
    """
    content = path.read_bytes()
    header, start = _header(content, str(path))
    body = content[start:]
    match header.data:
        case "ascii":
            return _ascii(header, body, str(path))
        case "binary":
            return _binary(header, body, str(path))
        case _:
            return _compressed(header, body, str(path))


def _header(content: bytes, place: str) -> tuple[_Header, int]:
    entries: dict[str, list[str]] = {}
    start, lines = 0, 0
    while "DATA" not in entries:
        end = content.find(b"\n", start, _HEADER_BYTES)
        if end < 0:
            raise DataError("not a PCD file: its header has no line DATA", place=place)
        words = content[start:end].decode("ascii", "replace").split()
        start, lines = end + 1, lines + 1
        if words and not words[0].startswith("#"):
            entries[words[0].upper()] = words[1:]
    names = [name.lower() for name in entries.get("FIELDS", entries.get("COLUMNS", []))]
    for axis in "xyz":
        if names.count(axis) != 1:
            raise DataError(
                f"the fields must be x, y and z among others; they are "
                f"{shortened(' '.join(names), 200)}",
                place=place,
            )
    kinds, sizes = entries.get("TYPE", []), entries.get("SIZE", [])
    counts = entries.get("COUNT", ["1"] * len(names))
    if not len(kinds) == len(sizes) == len(counts) == len(names):
        raise DataError(
            f"FIELDS names {len(names)} fields; TYPE, SIZE and COUNT have {len(kinds)}, "
            f"{len(sizes)} and {len(counts)} entries",
            place=place,
        )
    described = zip(names, kinds, sizes, counts, strict=True)
    fields = tuple(_field(*one, place) for one in described)
    for name, (_, count) in zip(names, fields, strict=True):
        if name in "xyz" and count != 1:
            raise DataError(f"field {name} has COUNT {count}; it must be 1", place=place)
    points = _count(entries, place)
    data = " ".join(entries["DATA"]).lower()
    if data not in ("ascii", "binary", "binary_compressed"):
        raise DataError(
            f"DATA is '{shortened(data)}'; it must be ascii, binary or binary_compressed",
            place=place,
        )
    return _Header(tuple(names), fields, points, data, lines), start


def _field(name: str, kind: str, size: str, count: str, place: str) -> tuple[str, int]:
    if not (size.isdecimal() and count.isdecimal() and int(size) in _SIZES.get(kind.upper(), ())):
        raise DataError(
            f"field {name} has the type {kind} of {size} bytes, {count} times; types are F of 4 or "
            "8 bytes, I and U of 1, 2, 4 or 8",
            place=place,
        )
    return f"<{_KINDS[kind.upper()]}{int(size)}", int(count)


def _count(entries: dict[str, list[str]], place: str) -> int:
    """Returns the number of points, which the header may give twice."""
    numbers: dict[str, int] = {}
    for key in ("WIDTH", "HEIGHT", "POINTS"):
        text = " ".join(entries.get(key, []))
        if text.isdecimal():
            numbers[key] = int(text)
        elif key in entries:
            raise DataError(f"{key} is '{shortened(text)}', not a number", place=place)
    area = numbers.get("WIDTH", 0) * numbers.get("HEIGHT", 1)
    points = numbers.get("POINTS", area)
    if "WIDTH" in numbers and area != points:
        raise DataError(f"POINTS is {points}, but WIDTH x HEIGHT is {area}", place=place)
    return points


def _ascii(header: _Header, body: bytes, place: str) -> Array:
    width = sum(count for _, count in header.fields)
    starts = np.cumsum([0, *(count for _, count in header.fields)])
    x, y, z = (int(starts[axis]) for axis in header.axes)
    rows = []
    for number, line in enumerate(body.decode("ascii", "replace").split("\n"), header.lines + 1):
        words = line.split()
        if not words:
            continue
        if len(words) != width:
            raise DataError(
                f"{len(words)} values; the fields need {width}", place=f"{place}:{number}"
            )
        try:
            rows.append((real(words[x]), real(words[y]), real(words[z])))
        except ValueError as error:
            raise DataError(str(error), place=f"{place}:{number}") from None
    if len(rows) != header.points:
        raise _wrong_count(header, len(rows), place)
    return np.array(rows, dtype=np.float64).reshape(-1, 3)


def _binary(header: _Header, body: bytes, place: str) -> Array:
    size = header.dtype.itemsize
    end = header.points * size
    if not end <= len(body) < end + size:
        raise _wrong_count(header, len(body) // size, place)
    if body[end:].strip(b"\0 \r\n"):
        raise DataError(
            f"{len(body) - end} bytes more than the header announces; a SIZE, COUNT or POINTS is "
            "wrong, or the file is damaged",
            place=place,
        )
    rows = np.frombuffer(body, header.dtype, header.points)
    return np.column_stack([rows[str(axis)][:, 0].astype(np.float64) for axis in header.axes])


def _compressed(header: _Header, body: bytes, place: str) -> Array:
    if len(body) < 8:
        raise DataError("the file ends before its compressed points", place=place)
    packed, unpacked = (int(size) for size in np.frombuffer(body, "<u4", 2))
    wanted = header.points * header.dtype.itemsize
    if unpacked != wanted:
        raise DataError(
            f"announces {header.points} points of {header.dtype.itemsize} bytes, but {unpacked} "
            "compressed bytes",
            place=place,
        )
    if packed > len(body) - 8 or unpacked > MAX_EXPANSION * packed:
        raise DataError(
            f"{len(body) - 8} compressed bytes; the header announces {packed}, which would unpack "
            f"to {unpacked}",
            place=place,
        )
    plain = decompress(np.frombuffer(body, np.uint8, packed, 8), unpacked)
    if len(plain) != wanted:
        raise DataError("the compressed points are damaged", place=place)
    sizes = [np.dtype(kind).itemsize * count for kind, count in header.fields]
    starts = np.cumsum([0, *sizes]) * header.points
    columns = [
        np.frombuffer(plain, header.fields[axis][0], header.points, int(starts[axis]))
        for axis in header.axes
    ]
    return np.column_stack(columns).astype(np.float64)


def _wrong_count(header: _Header, held: float, place: str) -> DataError:
    return DataError(
        f"announces {header.points} points, but holds {held:.9g}; the file is cut short or damaged",
        place=place,
    )
