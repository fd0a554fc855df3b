"""Elements of Matroska files: https://www.rfc-editor.org/rfc/rfc8794 and rfc9559."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import BinaryIO

from regkit.system.errors import DataError

EBML, SEGMENT = 0x1A45DFA3, 0x18538067
INFO, TIMESTAMP_SCALE = 0x1549A966, 0x2AD7B1
TRACKS, TRACK, NUMBER, NAME, CODEC, CODEC_PRIVATE = 0x1654AE6B, 0xAE, 0xD7, 0x536E, 0x86, 0x63A2
DURATION, VIDEO, WIDTH, HEIGHT = 0x23E383, 0xE0, 0xB0, 0xBA
ATTACHMENTS, ATTACHED, FILE_NAME, FILE_DATA = 0x1941A469, 0x61A7, 0x466E, 0x465C
CLUSTER, TIMESTAMP, SIMPLE_BLOCK, BLOCK_GROUP, BLOCK = 0x1F43B675, 0xE7, 0xA3, 0xA0, 0xA1

LARGEST = 1 << 26
"""Largest size of an element that is read at once [bytes]."""


@dataclass(frozen=True)
class Element:
    """An element's place in the file.

    Attributes:
        id: Its identifier, with the marker of its length.
        start: Position of its content.
        end: Position behind its content.
        cut: Whether the file ends before the content does.
    """

    id: int
    start: int
    end: int
    cut: bool = False

    def inside(self, file: BinaryIO) -> Iterator[Element]:
        """Yields the elements within it, each read from its own position.

        Raises:
            DataError: If one is damaged, or reaches beyond it.
        """
        at = self.start
        while at < self.end:
            file.seek(at)
            found = _element(file, self.end)
            yield found
            at = found.end

    def content(self, file: BinaryIO) -> bytes:
        """Returns its bytes.

        Raises:
            DataError: If they are too many, or the file ends before them.
        """
        size = self.end - self.start
        if size > LARGEST:
            raise DataError(f"an element of {size} bytes")
        file.seek(self.start)
        return exactly(file, size)

    def number(self, file: BinaryIO) -> int:
        """Returns its content as an unsigned number."""
        return int.from_bytes(self.content(file)[:8], "big")

    def text(self, file: BinaryIO) -> str:
        """Returns its content as text."""
        return self.content(file).rstrip(b"\0").decode("utf-8", errors="replace")


def whole(file: BinaryIO) -> Element:
    """Returns the file as an element, whose inside is its header and its segment."""
    return Element(0, 0, file.seek(0, 2))


def exactly(file: BinaryIO, size: int) -> bytes:
    """Returns the next bytes.

    Raises:
        DataError: If the file ends before them.
    """
    content = file.read(size)
    if len(content) < size:
        raise DataError("the file is cut short")
    return content


def variable(file: BinaryIO, *, marked: bool) -> int | None:
    """Returns a number of variable length; None if all its bits are set: an unknown size.

    Args:
        file: The file, at the number.
        marked: Whether the bit that marks the length is kept, as in identifiers.

    Raises:
        DataError: If it is longer than eight bytes, or the file ends before it.
    """
    first = exactly(file, 1)[0]
    length = 9 - first.bit_length()
    if length > 8:
        raise DataError("the file is damaged: a number of more than eight bytes")
    value = int.from_bytes(bytes([first]) + exactly(file, length - 1), "big")
    if marked:
        return value
    value -= 1 << (7 * length)
    return None if value == (1 << (7 * length)) - 1 else value


def _element(file: BinaryIO, end: int) -> Element:
    """Returns the element at the file's position, of a parent that ends at ``end``."""
    kind, size = variable(file, marked=True), variable(file, marked=False)
    start = file.tell()
    if size is None:
        # A recorder that was killed leaves the size of the segment unknown.
        return Element(kind or 0, start, end)
    if start + size > end and kind not in (SEGMENT, CLUSTER):
        raise DataError("the file is cut short or damaged: an element reaches beyond its parent")
    # What is whole in a segment or a cluster that is cut short can be read.
    return Element(kind or 0, start, min(start + size, end), cut=start + size > end)
