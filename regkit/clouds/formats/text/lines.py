"""Lines of text files of any common encoding."""

from __future__ import annotations

import codecs
import re
from pathlib import Path

from regkit.system.errors import DataError

_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
"""Byte order marks and their encodings; that of UTF-32 begins with that of UTF-16."""

_ODD_END = re.compile("(?<=[0-9.])[\x0b\x0c\x1c-\x1e\x85\u2028\u2029](?=[-+.0-9])")
"""A rare character between two numbers, which some programs take for the end of a line."""


def lines_of(path: Path) -> list[str]:
    """Returns the lines of a text file, the first being line 1.

    Bytes that are not UTF-8 are Latin-1, which only names of columns can need.

    Raises:
        DataError: If the file holds NUL bytes, as binary files do, or rare ends of lines.
    """
    # Control-Z ended files of DOS.
    content = path.read_bytes().rstrip(b"\x1a")
    encoding = next((name for mark, name in _MARKS if content.startswith(mark)), None)
    if encoding is None and b"\0" in content:
        line = content[: content.index(b"\0")].count(b"\n") + 1
        raise DataError(
            "a NUL byte: this is a binary file, or UTF-16 without its mark; save it as UTF-8",
            place=f"{path}:{line}",
        )
    try:
        text = content.decode(encoding or "utf-8")
    except UnicodeDecodeError:
        if encoding is not None:
            raise DataError(f"damaged text: not {encoding}", place=str(path)) from None
        text = content.decode("latin-1")
    # str.splitlines would also break lines at form feeds and other rare characters.
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    odd = _ODD_END.search(text)
    if odd is not None:
        number = next(n for n, line in enumerate(lines, 1) if _ODD_END.search(line))
        raise DataError(
            f"the character {odd.group()!r} is between two numbers, and may be the end of a line; "
            "end lines by a line feed",
            place=f"{path}:{number}",
        )
    return lines
