"""The methods against each other, coloured by shape model."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from regkit.metrics import Summary, summary
from regkit.metrics.statistics import FEWEST
from regkit.report.plot import NAME, Ink, Plot, canvas, legend_above, styled
from regkit.report.run import Run
from regkit.report.words import NAMES, axis_label, broken, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def method_means(run: Run) -> Plot | None:
    """Each method's mean over the recordings, its 95 % interval, and the recordings themselves."""
    figures = [run.figure]
    if run.compared:
        figures.append("joint_error_adjusted_cm")
    figures = [
        name for name in figures if any(_values(run, method, name) for method in run.finished)
    ]
    if not figures:
        return None
    rows = []
    for method in run.finished:
        for name in figures:
            found = summary(_values(run, method, name))
            low, high = found.interval or (None, None)
            rows.append((method, run.style(method).shape, name, found.n, found.mean, found.median,
                         low, high))  # fmt: skip
    enough = len(run.recordings) >= FEWEST
    caption = (
        f"The mean over the recordings of the {NAMES[run.figure]}"
        + (", as it is and adjusted" if len(figures) > 1 else "")
        + (", with its 95 % bootstrap interval" if enough else "")
        + "; the pale points are the recordings, and methods of one shape model stand together."
        + ("" if enough else f" Fewer than {FEWEST} recordings allow no interval.")
    )

    def draw(ink: Ink) -> Figure:
        return _drawn(run, figures, ink)

    return Plot(
        name="methods",
        title="The methods",
        caption=caption,
        alt=f"Points with intervals. {caption} The numbers are in methods.csv.",
        draw=draw,
        columns=[
            "method",
            "shape model",
            "figure (cm or mm by its name)",
            "recordings",
            "mean",
            "median",
            "95 % interval from",
            "to",
        ],
        rows=rows,
    )


def _values(run: Run, method: str, figure: str) -> list[float]:
    values = [run.value(method, recording, figure) for recording in run.finished[method]]
    return [value for value in values if value is not None]


def _drawn(run: Run, figures: list[str], ink: Ink) -> Figure:
    from matplotlib.patches import Patch

    families = list(dict.fromkeys(run.style(method).shape for method in run.finished))
    methods = sorted(run.finished, key=lambda name: families.index(run.style(name).shape))
    figure = canvas(ink, 0.9 + 0.3 * len(methods) + 0.12 * len(families))
    grid = figure.subplots(1, len(figures), sharey=True, squeeze=False)[0]
    places = {name: index + 0.4 * families.index(run.style(name).shape)
              for index, name in enumerate(methods)}  # fmt: skip
    for axes, name in zip(grid, figures, strict=True):
        styled(axes, ink, grid="x")
        for method, place in places.items():
            values = _values(run, method, name)
            if not values:
                continue
            style = run.style(method)
            spread = np.linspace(-0.16, 0.16, len(values)) if len(values) > 1 else [0.0]
            axes.scatter(values, place + np.asarray(spread), s=9, color=style.colour, alpha=0.35,
                         linewidths=0)  # fmt: skip
            _mark(axes, summary(values), place, style.colour, style.marker)
        largest = max(value for method in places for value in _values(run, method, name))
        axes.set_xlim(0.0, 1.06 * largest or 1.0)
        axes.set_xlabel(axis_label(name).replace("mean joint", "joint"))
        axes.tick_params(axis="y", length=0)
    grid[0].set_yticks(list(places.values()), [broken(label(name), NAME) for name in places])
    grid[0].set_ylim(max(places.values()) + 0.5, -0.5)
    if len(families) > 1:
        handles = [
            Patch(facecolor=_colour(run, family), label=label(family)) for family in families
        ]
        legend_above(figure, ink, handles, "shape model")
    return figure


def _colour(run: Run, family: str) -> str:
    """The colour of a shape model's first method."""
    return next(run.style(name).colour for name in run.finished if run.style(name).shape == family)


def _mark(axes: Axes, found: Summary, place: float, colour: str, marker: str) -> None:
    if found.interval is not None:
        axes.plot(found.interval, [place, place], color=colour, linewidth=2.2,
                  solid_capstyle="butt")  # fmt: skip
    assert found.mean is not None
    axes.plot([found.mean], [place], marker=marker, color=colour, markersize=6.5)
