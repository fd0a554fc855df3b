"""The figure of the methods' means, coloured by shape model."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from regkit.metrics import Summary, summary
from regkit.metrics.statistics import MIN_SAMPLES
from regkit.report.labels import NAMES, axis_label, label, wrapped
from regkit.report.plot import NAME, Ink, Plot, canvas, legend_above, styled
from regkit.report.run import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def method_means(run: Run) -> Plot | None:
    """Returns the plot of each method's mean with its 95 % interval, and of its recordings."""
    metrics = [run.metric]
    if run.compared:
        metrics.append("joint_error_adjusted_cm")
    metrics = [
        name for name in metrics if any(_values(run, method, name) for method in run.finished)
    ]
    if not metrics:
        return None
    rows = []
    for method in run.finished:
        for name in metrics:
            found = summary(_values(run, method, name))
            low, high = found.interval or (None, None)
            rows.append((method, run.style(method).shape, name, found.n, found.mean, found.median,
                         low, high))  # fmt: skip
    enough = len(run.recordings) >= MIN_SAMPLES
    caption = (
        f"The mean over the recordings of the {NAMES[run.metric]}"
        + (", raw and adjusted" if len(metrics) > 1 else "")
        + (", with its 95 % bootstrap interval" if enough else "")
        + "; pale points are single recordings, and methods are grouped by shape model."
        + ("" if enough else f" An interval needs at least {MIN_SAMPLES} recordings.")
    )

    def draw(ink: Ink) -> Figure:
        return _drawn(run, metrics, ink)

    return Plot(
        name="methods",
        title="The methods",
        caption=caption,
        alt=f"Points with intervals. {caption} The numbers are in methods.csv.",
        draw=draw,
        columns=[
            "method",
            "shape model",
            "metric (cm or mm by its name)",
            "recordings",
            "mean",
            "median",
            "95 % interval from",
            "to",
        ],
        rows=rows,
    )


def _values(run: Run, method: str, metric: str) -> list[float]:
    values = [run.value(method, recording, metric) for recording in run.finished[method]]
    return [value for value in values if value is not None]


def _drawn(run: Run, metrics: list[str], ink: Ink) -> Figure:
    from matplotlib.patches import Patch

    families = list(dict.fromkeys(run.style(method).shape for method in run.finished))
    methods = sorted(run.finished, key=lambda name: families.index(run.style(name).shape))
    figure = canvas(ink, 0.9 + 0.3 * len(methods) + 0.12 * len(families))
    grid = figure.subplots(1, len(metrics), sharey=True, squeeze=False)[0]
    places = {name: index + 0.4 * families.index(run.style(name).shape)
              for index, name in enumerate(methods)}  # fmt: skip
    for axes, name in zip(grid, metrics, strict=True):
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
        # Two panels have half of the width each.
        axes.set_xlabel(axis_label(name).replace("mean joint", "joint").replace(", ", ",\n"))
        axes.tick_params(axis="y", length=0)
    grid[0].set_yticks(list(places.values()), [wrapped(label(name), NAME) for name in places])
    grid[0].set_ylim(max(places.values()) + 0.5, -0.5)
    if len(families) > 1:
        handles = [
            Patch(facecolor=_colour(run, family), label=label(family)) for family in families
        ]
        legend_above(figure, ink, handles, "shape model")
    return figure


def _colour(run: Run, family: str) -> str:
    """Returns the colour of a shape model's first method."""
    return next(run.style(name).colour for name in run.finished if run.style(name).shape == family)


def _mark(axes: Axes, found: Summary, place: float, colour: str, marker: str) -> None:
    if found.interval is not None:
        axes.plot(found.interval, [place, place], color=colour, linewidth=2.2,
                  solid_capstyle="butt")  # fmt: skip
    assert found.mean is not None
    axes.plot([found.mean], [place], marker=marker, color=colour, markersize=6.5)
