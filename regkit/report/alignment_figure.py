"""A figure of two clouds before and after alignment."""

from __future__ import annotations

from typing import TYPE_CHECKING

from regkit.system.arrays import Array

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_VIEWS = {"along z": 0, "along x": 2}
"""The horizontal axis of each view; y points down, as in the camera frame."""


def alignment_figure(source: Array, aligned: Array, target: Array) -> Figure:
    """Returns a figure of a source over a target before and after alignment, from two views.

    Args:
        source: Source points, (N, 3) [m].
        aligned: Source points after alignment, (N, 3) [m].
        target: Target points, (M, 3) [m].
    """
    from regkit.report.shown_figure import ShownFigure

    figure = ShownFigure(7.2, 7.2, "white")
    grid = figure.subplots(2, 2)
    for row, (points, when) in enumerate(((source, "before"), (aligned, "after"))):
        for column, (view, across) in enumerate(_VIEWS.items()):
            plot = grid[row, column]
            plot.scatter(target[:, across], target[:, 1], s=1.5, c="0.6", lw=0, label="target")
            plot.scatter(points[:, across], points[:, 1], s=1.5, c="tab:blue", lw=0, label="source")
            plot.set_aspect("equal")
            plot.invert_yaxis()
            plot.set_title(f"{when}, {view}", fontsize=9)
            plot.tick_params(labelsize=7)
            plot.set_xlabel("xyz"[across] + " [m]", fontsize=8)
            plot.set_ylabel("y [m]", fontsize=8)
    handles, labels = grid[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=2, fontsize=8, markerscale=4)
    return figure
