"""Pictures of a rigid cloud before and after it was laid on another."""

from __future__ import annotations

from typing import TYPE_CHECKING

from regkit.system.arrays import Array

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_VIEWS = {"along z": 0, "along x": 2}
"""The axis that a view shows to the right; y points down, as in a camera's frame."""


def before_after(source: Array, aligned: Array, target: Array) -> Figure:
    """A source (N, 3) over a target (M, 3), as it was and as it was laid there (N, 3) [m]."""
    # The object interface needs no display and leaves no global state behind.
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.2, 7.2), layout="constrained", facecolor="white")
    FigureCanvasAgg(figure)
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
