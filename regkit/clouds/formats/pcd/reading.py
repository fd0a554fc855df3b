"""The points of PCD files."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from regkit.clouds.formats.lzf import MAX_EXPANSION, decompress
from regkit.clouds.formats.pcd.header import Header, read_header
from regkit.clouds.organised import OrganisedCloud
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.plain_numbers import real


def read_pcd(path: Path) -> Array:
    """Returns the points (N, 3) of a PCD file; missing measurements are NaN.

    Raises:
        DataError: If the header is invalid, or announces more or less than the file holds.
    """
    content = path.read_bytes()
    header, start = read_header(content, str(path))
    return _points(header, content[start:], str(path))


def read_organised_pcd(path: Path) -> OrganisedCloud | None:
    """Returns a cloud of several rows (HEIGHT), as an image has them; None for any other.

    Raises:
        DataError: If the header is invalid, or announces more or less than the file holds.
    """
    content, place = path.read_bytes(), str(path)
    header, start = read_header(content, place)
    if header.height < 2 or not header.points:
        return None
    points = _points(header, content[start:], place)
    return OrganisedCloud(points.reshape(header.height, -1, 3), header.sensor_pose(place))


def _points(header: Header, body: bytes, place: str) -> Array:
    match header.data:
        case "ascii":
            return _ascii(header, body, place)
        case "binary":
            return _binary(header, body, place)
        case _:
            return _compressed(header, body, place)


def _ascii(header: Header, body: bytes, place: str) -> Array:
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


def _binary(header: Header, body: bytes, place: str) -> Array:
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


def _compressed(header: Header, body: bytes, place: str) -> Array:
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


def _wrong_count(header: Header, held: float, place: str) -> DataError:
    return DataError(
        f"announces {header.points} points, but holds {held:.9g}; the file is cut short or damaged",
        place=place,
    )
