"""Reading of depth images from files."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from regkit.system.arrays import Array
from regkit.system.errors import DataError


def read_depth(path: Path) -> Array:
    """Reads the values (H, W) of a single-channel 16-bit image, in units of the file.

    Raises:
        DataError: If the file is missing, damaged, or an image of another kind.
    """
    from PIL import Image, UnidentifiedImageError

    try:
        with Image.open(path) as image:
            mode = image.mode
            values = np.asarray(image)
    except FileNotFoundError:
        raise DataError("there is no such image", place=str(path)) from None
    except (OSError, SyntaxError, UnidentifiedImageError, Image.DecompressionBombError) as error:
        raise DataError(f"the image is damaged or cut short: {error}", place=str(path)) from None
    if not mode.startswith("I"):
        raise DataError(
            f"a depth image has one channel of 16 bits; this one is of the mode {mode}",
            place=str(path),
        )
    return values.astype(np.float64)
