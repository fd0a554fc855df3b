"""A figure that a notebook shows."""

from __future__ import annotations

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from regkit.report.png import png


class ShownFigure(Figure):
    """A figure of Matplotlib's object interface, which needs no display and has no global state.

    A notebook shows figures of Matplotlib only once ``matplotlib.pyplot`` is imported, and this one
    always.
    """

    def __init__(self, width: float, height: float, paper: str) -> None:
        """Makes an empty figure of a width and height [in]."""
        super().__init__(figsize=(width, height), layout="constrained", facecolor=paper)
        FigureCanvasAgg(self)

    def _repr_png_(self) -> bytes:
        """Returns the picture, for a notebook."""
        return png(self, self.dpi)
