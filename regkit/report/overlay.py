"""Overlays: images of the registered body over the data."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from regkit.body.verdict import Verdict
from regkit.report.frame_drawing import FrameDrawing
from regkit.report.outlines import outlines
from regkit.report.plot import LIGHT, canvas, inked, styled
from regkit.report.png import png
from regkit.report.record import Record
from regkit.system.files import replacing

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

VIEWS = {"from the front": (0, 1), "from its left": (2, 1)}
"""The horizontal and the vertical axis of each view, in the camera frame."""

DPI = 110

BONE, FOUND = "#4D4D4D", "#B00020"


def draw_overlay(path: Path, title: str, record: Record, colour: str) -> None:
    """Writes the ``overlay`` of a record to a PNG file.

    Args:
        path: The file.
        title: Title of the image.
        record: The tracked recording.
        colour: Colour of the shape model.

    Raises:
        DataError: If the file cannot be written.
    """
    figure = overlay(title, record, colour)
    with replacing(path) as temporary:
        temporary.write_bytes(png(figure, DPI))


def overlay(title: str, record: Record, colour: str) -> Figure:
    """Returns a figure of the first, the worst and the last frame, from the front and the side.

    Gaussians are drawn as outlines of their 2-sigma ellipsoids, capsules and other solids as their
    outlines, points and primitives of large models as dots, reference joints as crosses.

    Args:
        title: Title of the figure.
        record: The tracked recording.
        colour: Colour of the shape model.
    """
    drawings = record.drawings
    figure = canvas(LIGHT, 7.2, width=2.9 * len(drawings))
    figure.suptitle(title, fontsize=11)
    grid = figure.subplots(len(VIEWS), len(drawings), squeeze=False)
    for column, drawing in enumerate(drawings):
        for row, (view, axes) in enumerate(VIEWS.items()):
            plot = styled(grid[row, column], LIGHT)
            _draw(plot, axes, drawing, colour)
            title = f"frame {drawing.frame} ({drawing.why}), {view}"
            verdict = record.verdicts[drawing.frame]
            if verdict == Verdict.FOUND:
                plot.set_title(title, fontsize=8.5)
            else:
                # A drawn pose looks right in any case.
                plot.set_title(f"{title}\nbody {verdict}", fontsize=8.5, color=FOUND)
    handles, labels = grid[0, 0].get_legend_handles_labels()
    legend = figure.legend(
        handles, labels, loc="outside lower center", ncols=len(labels), fontsize=8
    )
    inked(legend, LIGHT)
    return figure


def _draw(plot: Axes, view: tuple[int, int], drawing: FrameDrawing, colour: str) -> None:
    from matplotlib.collections import LineCollection, PolyCollection
    from matplotlib.colors import to_rgba

    across, down = view
    points, primitives = drawing.points, drawing.primitives
    plot.scatter(points[:, across], points[:, down], s=2, c="0.72", linewidths=0)
    if primitives.kind == "points":
        plot.scatter(
            primitives.centres[:, across], primitives.centres[:, down], s=1, c=colour, linewidths=0
        )
    # As collections they are drawn in a fraction of the time.
    shapes = [outline.T for outline in outlines(primitives, view)]
    faint = to_rgba(colour, 0.10)
    plot.add_collection(PolyCollection(shapes, facecolor=faint, edgecolor=colour, linewidth=0.8))
    bones = drawing.bones[:, :, [across, down]]
    plot.add_collection(LineCollection(list(bones), color=BONE, linewidth=1.2))
    markers, reference = drawing.markers, drawing.reference
    plot.plot(markers[:, across], markers[:, down], ".", color=FOUND, markersize=5, label="found")
    if len(reference):
        plot.plot(reference[:, across], reference[:, down], "k+", markersize=6, label="reference")
    plot.set_aspect("equal")
    plot.invert_yaxis()
    plot.tick_params(labelsize=7)
    plot.locator_params(axis="x", nbins=4)
    plot.set_xlabel("x [m]" if across == 0 else "z [m]", fontsize=8)
    plot.set_ylabel("y [m]", fontsize=8)
