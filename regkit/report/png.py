"""Figures as small PNG files."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLOURS = 256
"""A figure has few colours; a palette makes its file a third as large."""


def png(figure: Figure, dpi: float) -> bytes:
    """The picture of a figure."""
    from PIL import Image

    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=dpi)
    with Image.open(stream) as picture:
        small = picture.convert("RGB").quantize(
            COLOURS, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE
        )
    written = io.BytesIO()
    small.save(written, format="png", dpi=(dpi, dpi))
    return written.getvalue()
