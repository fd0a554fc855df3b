"""Plots: figures with their captions and data, drawn on a light or a dark background."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from regkit.report.png import png
from regkit.system.csv_table import csv_text
from regkit.system.files import replacing, write_text

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.legend import Legend

WIDTH = 5.4
"""Width of a figure [in], narrow enough to be legible on a phone."""

DPI = 160

LINE = 0.19
"""Height of a row of a legend [in]."""

NAME = 30
"""Maximum number of characters of a name in one line beside an axis."""

Value = str | float | int | None


@dataclass(frozen=True)
class Ink:
    """The colours of a figure.

    Attributes:
        text: Colour of text and axes.
        faint: Colour of grids and backgrounds.
        paper: Colour of the figure's background.
    """

    text: str
    faint: str
    paper: str


LIGHT = Ink(text="#222222", faint="#D5D5D5", paper="#FFFFFF")
DARK = Ink(text="#E4E4E4", faint="#4A4D52", paper="#1B1D20")


@dataclass(frozen=True)
class Plot:
    """A figure of the report with its data.

    Attributes:
        name: Stem of its file names.
        title: Heading.
        caption: Caption.
        alt: Alternative text for screen readers.
        draw: Function that draws the figure in given colours.
        columns: Headings of the data's columns, with units.
        rows: The data.
    """

    name: str
    title: str
    caption: str
    alt: str
    draw: Callable[[Ink], Figure]
    columns: Sequence[str]
    rows: Sequence[Sequence[Value]]

    def png(self, ink: Ink) -> bytes:
        """Returns the figure as PNG."""
        return png(self.draw(ink), DPI)

    def write(self, folder: Path, picture: bytes) -> None:
        """Writes the image as PNG and the data as CSV.

        Args:
            folder: The folder for both files.
            picture: The PNG image.

        Raises:
            DataError: If a file cannot be written.
        """
        with replacing(folder / f"{self.name}.png") as temporary:
            temporary.write_bytes(picture)
        write_csv(folder / f"{self.name}.csv", self.columns, self.rows)


def write_csv(path: Path, columns: Sequence[str], rows: Iterable[Sequence[Value]]) -> None:
    """Writes a table as CSV; unknown values are empty cells.

    Raises:
        DataError: If the file cannot be written.
    """
    write_text(path, csv_text(columns, ([_cell(value) for value in row] for row in rows)))


def _cell(value: Value) -> str:
    if value is None or (isinstance(value, float) and not np.isfinite(value)):
        return ""
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def canvas(ink: Ink, height: float, width: float = WIDTH) -> Figure:
    """Returns an empty figure of a height and width [in]."""
    from regkit.report.shown_figure import ShownFigure

    return ShownFigure(width, height, ink.paper)


def styled(axes: Axes, ink: Ink, grid: str | None = None) -> Axes:
    """Styles axes in the colours of ``ink``, with grid lines for ``x``, ``y`` or neither."""
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
    """Adds a legend above all axes.

    Args:
        figure: The figure; its height grows with the rows of the legend.
        ink: Colours of the figure.
        handles: Artists of the legend; by default the labelled ones of the first axes.
        title: Title of the legend.
    """
    if handles is None:
        handles = list(figure.axes[0].get_legend_handles_labels()[0])
    widest = max((len(str(handle.get_label())) for handle in handles), default=1)
    fitting = max(1, int(figure.get_figwidth() / (0.6 + 0.075 * widest)))
    # Balance the rows: five entries are three and two, not four and one.
    rows = -(-len(handles) // fitting)
    # The axes keep their height for any number of rows.
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
    """Styles a legend in the colours of ``ink``, without a frame."""
    legend.set_frame_on(False)
    legend.get_title().set_color(ink.text)
    for text in legend.get_texts():
        text.set_color(ink.text)
