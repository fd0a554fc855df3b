"""Pictures of a body over the points that it was registered to."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from regkit.report.look import Look
from regkit.report.outlines import outlines
from regkit.report.plot import LIGHT, canvas, inked, styled
from regkit.report.png import png
from regkit.report.record import Record
from regkit.system.files import replacing

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

VIEWS = {"from the front": (0, 1), "from its left": (2, 1)}
"""The two axes of the camera's frame that a view shows, to the right and down."""

DPI = 110

BONE, FOUND = "#4D4D4D", "#B00020"


def draw_overlay(path: Path, title: str, record: Record, colour: str) -> None:
    """Draw the ``overlay`` to a PNG file."""
    figure = overlay(title, record, colour)
    with replacing(path) as temporary:
        temporary.write_bytes(png(figure, DPI))


def overlay(title: str, record: Record, colour: str) -> Figure:
    """The first, the worst and the last frame from the front and from the side.

    Gaussians are drawn as the outlines of their 2-sigma ellipsoids, capsules and spheres as their
    own, what is a point or one of very many as dots, reference joints as crosses.

    Args:
        title: Of the picture.
        record: What was tracked.
        colour: Of the shape model.
    """
    looks = record.looks
    figure = canvas(LIGHT, 7.2, width=2.9 * len(looks))
    figure.suptitle(title, fontsize=11)
    grid = figure.subplots(len(VIEWS), len(looks), squeeze=False)
    for column, look in enumerate(looks):
        for row, (view, axes) in enumerate(VIEWS.items()):
            plot = styled(grid[row, column], LIGHT)
            _draw(plot, axes, look, colour)
            plot.set_title(f"frame {look.frame} ({look.why}), {view}", fontsize=8.5)
    handles, labels = grid[0, 0].get_legend_handles_labels()
    legend = figure.legend(
        handles, labels, loc="outside lower center", ncols=len(labels), fontsize=8
    )
    inked(legend, LIGHT)
    return figure


def _draw(plot: Axes, view: tuple[int, int], look: Look, colour: str) -> None:
    across, down = view
    points, form = look.points, look.form
    plot.scatter(points[:, across], points[:, down], s=2, c="0.72", linewidths=0)
    if form.kind == "points":
        plot.scatter(form.centres[:, across], form.centres[:, down], s=1, c=colour, linewidths=0)
    for outline in outlines(form, view):
        plot.fill(*outline, facecolor=colour, alpha=0.10)
        plot.plot(*outline, color=colour, linewidth=0.8)
    for bone in look.bones:
        plot.plot(bone[:, across], bone[:, down], color=BONE, lw=1.2)
    markers, reference = look.markers, look.reference
    plot.plot(markers[:, across], markers[:, down], ".", color=FOUND, markersize=5, label="found")
    if len(reference):
        plot.plot(reference[:, across], reference[:, down], "k+", markersize=6, label="reference")
    plot.set_aspect("equal")
    plot.invert_yaxis()
    plot.tick_params(labelsize=7)
    plot.locator_params(axis="x", nbins=4)
    plot.set_xlabel("x [m]" if across == 0 else "z [m]", fontsize=8)
    plot.set_ylabel("y [m]", fontsize=8)
