"""Damage within a PNG image: its chunks, with checksums that are right."""

from __future__ import annotations

import io
import struct
import zlib
from collections.abc import Callable
from random import Random

import numpy as np
from PIL import Image

from tests.fuzz.mutations.unsuitable import UnsuitableError

SIGNATURE = b"\x89PNG\r\n\x1a\n"
Chunks = list[tuple[bytes, bytes]]


def _chunks(content: bytes) -> Chunks:
    found, at = [], len(SIGNATURE)
    while content.startswith(SIGNATURE) and at + 12 <= len(content):
        (size,) = struct.unpack(">I", content[at : at + 4])
        found.append((content[at + 4 : at + 8], content[at + 8 : at + 8 + size]))
        at += 12 + size
    if not found or found[0][0] != b"IHDR" or len(found[0][1]) != 13:
        raise UnsuitableError
    return found


def _joined(chunks: Chunks) -> bytes:
    packed = (
        struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        for name, data in chunks
    )
    return SIGNATURE + b"".join(packed)


def _on_chunks(change: Callable[[Random, Chunks], Chunks]) -> Callable[[Random, bytes], bytes]:
    return lambda random, content: _joined(change(random, _chunks(content)))


def size(random: Random, chunks: Chunks) -> Chunks:
    head = bytearray(chunks[0][1])
    at = random.choice((0, 4))
    (now,) = struct.unpack(">I", head[at : at + 4])
    other = random.choice((0, 1, now + 1, now - 1, 2 * now, 60_000, 2**31 - 1))
    head[at : at + 4] = struct.pack(">I", other % 2**32)
    return [(b"IHDR", bytes(head)), *chunks[1:]]


def depth_or_colour(random: Random, chunks: Chunks) -> Chunks:
    head = bytearray(chunks[0][1])
    head[random.choice((8, 9, 12))] = random.choice((0, 1, 2, 3, 4, 6, 8, 16, 255))
    return [(b"IHDR", bytes(head)), *chunks[1:]]


def bomb(random: Random, chunks: Chunks) -> Chunks:
    """A comment of many megabytes that is small in the file only."""
    name, extra = random.choice(
        ((b"zTXt", b"k\0\0"), (b"iTXt", b"k\0\1\0\0\0"), (b"iCCP", b"k\0\0"))
    )
    data = extra + zlib.compress(bytes(random.choice((10**6, 10**8))), 9)
    return [chunks[0], (name, data), *chunks[1:]]


def remove(random: Random, chunks: Chunks) -> Chunks:
    at = random.randrange(len(chunks))
    return [*chunks[:at], *chunks[at + 1 :]]


def repeat(random: Random, chunks: Chunks) -> Chunks:
    at = random.randrange(len(chunks))
    return [*chunks[:at], *[chunks[at]] * random.choice((2, 3, 500)), *chunks[at + 1 :]]


def pixels(random: Random, chunks: Chunks) -> Chunks:
    """The rows of the image, with other filters and values, or too many, or too few."""
    rows = zlib.decompressobj()
    try:
        data = bytearray(rows.decompress(b"".join(d for n, d in chunks if n == b"IDAT")))
    except zlib.error:
        raise UnsuitableError from None
    for _ in range(random.choice((1, 5, 50))):
        if data:
            data[random.randrange(len(data))] = random.randrange(256)
    packed = zlib.compress(bytes(data[: random.choice((None, -1, len(data) // 2))]))
    return [chunks[0], (b"IDAT", packed), (b"IEND", b"")]


def other_image(random: Random, content: bytes) -> bytes:
    """An image of another kind, or in another format."""
    mode = random.choice(("L", "RGB", "RGBA", "P", "1", "LA", "I;16", "F"))
    form = random.choice(("PNG", "PNG", "PNG", "TIFF", "BMP", "JPEG", "GIF"))
    image = Image.fromarray((np.arange(1200).reshape(30, 40) * 2).astype(np.uint16))
    stream = io.BytesIO()
    try:
        (image if mode == "I;16" else image.convert("L").convert(mode)).save(stream, form)
    except (OSError, ValueError):
        raise UnsuitableError from None
    return stream.getvalue()


IMAGES = {
    **{
        f"png.{one.__name__}": _on_chunks(one)
        for one in (size, depth_or_colour, bomb, remove, repeat, pixels)
    },
    "png.other_image": other_image,
}
