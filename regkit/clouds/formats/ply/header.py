"""The header of a PLY file: elements and their properties."""

from __future__ import annotations

from dataclasses import dataclass, field

from regkit.system.errors import DataError

TYPES = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4",
    "float": "f4", "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2",
    "int32": "i4", "uint32": "u4", "int64": "i8", "uint64": "u8", "float32": "f4", "float64": "f8",
}  # fmt: skip
"""NumPy's names of the types of properties."""

ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
"""NumPy's byte order of each format; empty for text."""

_MAX_BYTES = 1 << 20


@dataclass(frozen=True)
class Property:
    """A property of an element.

    Attributes:
        name: Its name in small letters.
        kind: NumPy's name of its type.
        count: NumPy's name of the type of its length if it is a list; None for a single value.
    """

    name: str
    kind: str
    count: str | None


@dataclass
class Element:
    """A kind of rows, such as vertices.

    Attributes:
        name: Its name in small letters.
        rows: Number of rows.
        properties: The values of a row.
    """

    name: str
    rows: int
    properties: list[Property] = field(default_factory=list)


@dataclass
class Header:
    """The header of a file.

    Attributes:
        order: NumPy's byte order; empty for text.
        elements: The elements in order.
        size: Number of its bytes.
        lines: Number of its lines.
    """

    order: str
    elements: list[Element]
    size: int
    lines: int


def read_header(content: bytes, place: str) -> Header:
    """Returns the header of a file's content.

    Raises:
        DataError: If it is no valid header.
    """
    order: str | None = None
    elements: list[Element] = []
    start, number = 0, 0
    while True:
        end = content.find(b"\n", start, _MAX_BYTES)
        line = content[start:end].decode("latin-1").strip() if end >= 0 else ""
        start, number = end + 1, number + 1
        words = line.split()
        match words:
            case _ if end < 0 or (number == 1 and line != "ply"):
                raise DataError(
                    "not a PLY file: it has no header from ply to end_header", place=place
                )
            case ["ply"] | ["comment" | "obj_info", *_] | []:
                continue
            case ["format", kind, "1.0"] if kind in ORDERS:
                order = ORDERS[kind]
            case ["element", name, count] if count.isdecimal() and len(count) < 19:
                elements.append(Element(name.lower(), int(count)))
            case ["property", "list", count, kind, name] if (
                elements and kind in TYPES and TYPES.get(count, "f")[0] in "iu"
            ):
                one = Property(name.lower(), TYPES[kind], TYPES[count])
                elements[-1].properties.append(one)
            case ["property", kind, name] if elements and kind in TYPES:
                elements[-1].properties.append(Property(name.lower(), TYPES[kind], None))
            case ["end_header"] if order is not None:
                return Header(order, elements, start, number)
            case _:
                raise DataError(f"not a line of a header: '{line[:60]}'", place=f"{place}:{number}")
