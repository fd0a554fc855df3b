"""Reading of depth images from files."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import BinaryIO

import numpy as np

from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.guard import reading

MAX_PIXELS = 1 << 26
"""Largest number of pixels of an image; no depth camera has a tenth of it."""


def read_depth(path: Path) -> Array:
    """Reads the values (H, W) of a single-channel 16-bit PNG image, in units of the file.

    Raises:
        DataError: If the file is missing, damaged, too large, or an image of another kind.
    """
    if not path.exists():
        raise DataError("there is no such image", place=str(path))
    with reading(path, "a PNG depth image, or cut short"):
        return decoded_depth(path)


def decoded_depth(file: Path | BinaryIO) -> Array:
    """Returns the values (H, W) of a single-channel 16-bit PNG image, in units of the file.

    Raises:
        DataError: If it is too large, or an image of another kind.
        Exception: If it is damaged; libraries raise many.
    """
    from PIL import Image

    # The size is checked below, so Pillow's warning about it is superfluous.
    with (
        warnings.catch_warnings(action="ignore", category=Image.DecompressionBombWarning),
        Image.open(file, formats=("PNG",)) as image,
    ):
        width, height = image.size
        if width * height > MAX_PIXELS:
            raise DataError(
                f"the image announces {width}x{height} pixels; at most {MAX_PIXELS} are read"
            )
        if not image.mode.startswith("I"):
            raise DataError(
                f"a depth image has one channel of 16 bits; this one is of the mode {image.mode}"
            )
        return np.asarray(image).astype(np.float64)
