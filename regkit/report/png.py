"""Compact PNG images of figures."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLOURS = 256
"""Size of the palette. Figures have few colours, and a palette reduces the file to a third."""


def png(figure: Figure, dpi: float) -> bytes:
    """Returns a figure as PNG with a palette, at a resolution of ``dpi``."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from PIL import Image

    canvas, resolution = figure.canvas, figure.dpi
    try:
        figure.set_dpi(dpi)
        # ``savefig`` would draw twice, and make a file only to be read again.
        drawn: Any = FigureCanvasAgg(figure)
        drawn.draw()
        picture = Image.fromarray(np.asarray(drawn.buffer_rgba())).convert("RGB")
    finally:
        figure.set_dpi(resolution)
        figure.set_canvas(canvas)
    small = picture.quantize(COLOURS, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    written = io.BytesIO()
    small.save(written, format="png", dpi=(dpi, dpi))
    return written.getvalue()
