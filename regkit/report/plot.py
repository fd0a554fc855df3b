"""A figure with its numbers and words, drawn on light and on dark paper."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from regkit.report.png import png
from regkit.system.files import replacing, write_text

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.legend import Legend

WIDTH = 5.4
"""Of a figure, in inches; so narrow, its letters can still be read on a phone."""

DPI = 160

LINE = 0.19
"""Height of a legend's row, in inches."""

NAME = 30
"""So many letters of a name stand in one line beside an axis."""

Value = str | float | int | None


@dataclass(frozen=True)
class Ink:
    """What a figure is drawn with.

    Attributes:
        text: The colour of letters and axes.
        faint: Of grids, and of what stands behind.
        paper: What it is drawn on.
    """

    text: str
    faint: str
    paper: str


LIGHT = Ink(text="#222222", faint="#D5D5D5", paper="#FFFFFF")
DARK = Ink(text="#E4E4E4", faint="#4A4D52", paper="#1B1D20")


@dataclass(frozen=True)
class Plot:
    """A figure of the report.

    Attributes:
        name: Of its files.
        title: Its heading.
        caption: What is seen, and what it means.
        alt: The same for those who cannot see it.
        draw: Draws it.
        columns: What the numbers are, with their units.
        rows: The numbers.
    """

    name: str
    title: str
    caption: str
    alt: str
    draw: Callable[[Ink], Figure]
    columns: Sequence[str]
    rows: Sequence[Sequence[Value]]

    def png(self, ink: Ink) -> bytes:
        """The picture."""
        return png(self.draw(ink), DPI)

    def write(self, folder: Path, picture: bytes) -> None:
        """Write the picture, and the numbers beside it."""
        with replacing(folder / f"{self.name}.png") as temporary:
            temporary.write_bytes(picture)
        write_csv(folder / f"{self.name}.csv", self.columns, self.rows)


def write_csv(path: Path, columns: Sequence[str], rows: Iterable[Sequence[Value]]) -> None:
    """Write a table; what is not known is an empty cell."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows([_cell(value) for value in row] for row in rows)
    write_text(path, stream.getvalue())


def _cell(value: Value) -> str:
    if value is None or (isinstance(value, float) and not np.isfinite(value)):
        return ""
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def canvas(ink: Ink, height: float, width: float = WIDTH) -> Figure:
    """An empty figure; the object interface needs no display and leaves no global state behind."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained", facecolor=ink.paper)
    FigureCanvasAgg(figure)
    return figure


def styled(axes: Axes, ink: Ink, grid: str | None = None) -> Axes:
    """Axes in an ink, with lines along one of them (``x`` or ``y``) or none."""
    axes.set_facecolor(ink.paper)
    for side, spine in axes.spines.items():
        spine.set_visible(side in ("left", "bottom"))
        spine.set_color(ink.text)
        spine.set_linewidth(0.6)
    axes.tick_params(colors=ink.text, labelsize=8.5, width=0.6, length=3)
    for label in (axes.xaxis.label, axes.yaxis.label, axes.title):
        label.set_color(ink.text)
        label.set_fontsize(9)
    axes.set_axisbelow(True)
    if grid == "x":
        axes.grid(axis="x", color=ink.faint, linewidth=0.6)
    elif grid == "y":
        axes.grid(axis="y", color=ink.faint, linewidth=0.6)
    return axes


def legend_above(
    figure: Figure, ink: Ink, handles: Sequence[Artist] | None = None, title: str | None = None
) -> None:
    """A legend above all axes, of the artists that have labels or of others, in an ink."""
    if handles is None:
        handles = list(figure.axes[0].get_legend_handles_labels()[0])
    widest = max((len(str(handle.get_label())) for handle in handles), default=1)
    fitting = max(1, int(figure.get_figwidth() / (0.6 + 0.075 * widest)))
    # As even as may be: five are three and two, not four and one.
    rows = -(-len(handles) // fitting)
    # The axes keep their height, however many rows there are above them.
    figure.set_figheight(figure.get_figheight() + LINE * (rows - 1))
    legend = figure.legend(
        handles=handles,
        title=title,
        loc="outside upper center",
        ncols=-(-len(handles) // max(1, rows)),
        fontsize=8.5,
        title_fontsize=8.5,
    )
    inked(legend, ink)


def inked(legend: Legend, ink: Ink) -> None:
    """A legend without a frame, in an ink."""
    legend.set_frame_on(False)
    legend.get_title().set_color(ink.text)
    for text in legend.get_texts():
        text.set_color(ink.text)
