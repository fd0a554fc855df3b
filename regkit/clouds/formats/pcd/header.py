"""The header of a PCD file: fields, layout and viewpoint."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import to_matrix
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.plain_numbers import real
from regkit.system.printable import shortened

_KINDS = {"F": "f", "I": "i", "U": "u"}
_SIZES = {"F": (4, 8), "I": (1, 2, 4, 8), "U": (1, 2, 4, 8)}
_HEADER_BYTES = 1 << 16


@dataclass(frozen=True)
class Header:
    """What a PCD file announces.

    Attributes:
        names: Names of the fields.
        fields: Type and number of values of each field.
        points: Number of points.
        height: Number of rows of an organised cloud; 1 of any other.
        viewpoint: Words of the sensor's place and orientation: x y z, and a quaternion, w first.
        data: ``ascii``, ``binary`` or ``binary_compressed``.
        lines: Number of lines of the header.
    """

    names: tuple[str, ...]
    fields: tuple[tuple[str, int], ...]
    points: int
    height: int
    viewpoint: tuple[str, ...]
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

    def sensor_pose(self, place: str) -> Array:
        """Returns T_cloud_sensor, (4, 4).

        Raises:
            DataError: If the viewpoint is not a place and a quaternion.
        """
        if not self.viewpoint:
            return np.eye(4)
        try:
            values = np.array([real(word) for word in self.viewpoint])
        except ValueError:
            values = np.zeros(0)
        norm = float(np.linalg.norm(values[3:]))
        if len(values) != 7 or not np.isfinite(values).all() or not norm > 0.0:
            raise DataError(
                f"VIEWPOINT is '{shortened(' '.join(self.viewpoint))}'; it must be the sensor's x "
                "y z and its quaternion w x y z",
                place=place,
            )
        scalar_last = np.roll(values[3:] / norm, -1)
        return rigid(to_matrix(scalar_last), values[:3])


def read_header(content: bytes, place: str) -> tuple[Header, int]:
    """Returns the header of a file's content, and the number of its bytes.

    Raises:
        DataError: If it is no valid header.
    """
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
    points, height = _counts(entries, place)
    viewpoint = tuple(entries.get("VIEWPOINT", []))
    data = " ".join(entries["DATA"]).lower()
    if data not in ("ascii", "binary", "binary_compressed"):
        raise DataError(
            f"DATA is '{shortened(data)}'; it must be ascii, binary or binary_compressed",
            place=place,
        )
    return Header(tuple(names), fields, points, height, viewpoint, data, lines), start


def _field(name: str, kind: str, size: str, count: str, place: str) -> tuple[str, int]:
    if not (size.isdecimal() and count.isdecimal() and int(size) in _SIZES.get(kind.upper(), ())):
        raise DataError(
            f"field {name} has the type {kind} of {size} bytes, {count} times; types are F of 4 or "
            "8 bytes, I and U of 1, 2, 4 or 8",
            place=place,
        )
    return f"<{_KINDS[kind.upper()]}{int(size)}", int(count)


def _counts(entries: dict[str, list[str]], place: str) -> tuple[int, int]:
    """Returns the numbers of points, which the header may give twice, and of rows."""
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
    return points, numbers.get("HEIGHT", 1) if "WIDTH" in numbers else 1
