"""Depth images in messages of ROS.

- https://docs.ros.org/en/api/sensor_msgs/html/msg/Image.html
- https://github.com/ros-perception/image_transport_plugins, ``compressed_depth_image_transport``
"""

from __future__ import annotations

import io
import struct
from typing import Any

import numpy as np

from regkit.observation.depth_image import decoded_depth
from regkit.system.arrays import Array
from regkit.system.errors import DataError

ENCODINGS = {"16UC1": "u2", "32FC1": "f4"}
"""Types of the pixels of depth images: whole units, or metres."""

CODED = struct.Struct("<i2f")
"""Header of a compressed image: its coding, and the two parameters of inverse depths."""


def encoding_of(message: Any) -> str:
    """Returns the encoding of an image's message; empty if it is compressed but no depth image."""
    if hasattr(message, "encoding"):
        return str(message.encoding)
    encoding, _, coding = str(message.format).partition(";")
    return encoding.strip() if coding.strip().startswith("compressedDepth") else ""


def depth_of(message: Any, scale: float) -> Array:
    """Returns the depth image (H, W) [m] of a message; zero marks an invalid pixel.

    Args:
        message: The message of an image, or of a compressed one.
        scale: Units per metre of whole numbers.

    Raises:
        DataError: If its encoding is no depth image's, or its bytes are too few.
    """
    encoding = encoding_of(message)
    if encoding not in ENCODINGS:
        raise DataError(
            f"the encoding is {encoding or 'unknown'}; depth images have {' or '.join(ENCODINGS)}"
        )
    if not hasattr(message, "encoding"):
        return _decompressed(message, encoding, scale)
    values = _pixels(message, ENCODINGS[encoding])
    return values / scale if encoding == "16UC1" else _valid(values)


def _pixels(message: Any, kind: str) -> Array:
    """Returns the values (H, W) of an image, whose rows may be padded."""
    pixel = np.dtype(kind).newbyteorder(">" if message.is_bigendian else "<")
    height, width, step = int(message.height), int(message.width), int(message.step)
    row = width * pixel.itemsize
    if step < row or len(message.data) < step * (height - 1) + row:
        raise DataError(
            f"the image announces {width}x{height} pixels of {pixel.itemsize} bytes in rows of "
            f"{step}, but has {len(message.data)} bytes"
        )
    # The last row need not be padded.
    content = np.zeros(step * height, dtype=np.uint8)
    given = np.frombuffer(message.data, dtype=np.uint8)[: step * height]
    content[: len(given)] = given
    rows = content.reshape(height, step)[:, :row]
    return np.ascontiguousarray(rows).view(pixel).astype(np.float64)


def _valid(depth: Array) -> Array:
    """Returns depths of which those that are no measurement are zero."""
    return np.asarray(np.where(np.isfinite(depth) & (depth > 0.0), depth, 0.0))


def _decompressed(message: Any, encoding: str, scale: float) -> Array:
    """Returns the depth image [m] of a PNG image behind a header."""
    content = bytes(message.data)
    if "rvl" in str(message.format).lower():
        raise DataError(f"the compression '{message.format}' is not read; only PNG is")
    if len(content) <= CODED.size:
        raise DataError(f"a compressed depth image of {len(content)} bytes")
    _, above, offset = CODED.unpack_from(content)
    values = decoded_depth(io.BytesIO(content[CODED.size :]))
    if encoding == "16UC1":
        return values / scale
    # Distances are stored as their quantised inverse.
    depth = np.zeros_like(values)
    np.divide(above, values - offset, out=depth, where=values > 0.0)
    return _valid(depth)
