"""The figure of PCK curves: the percentage of joints within a threshold."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from regkit.metrics import PCK_FRACTION, fraction_within
from regkit.metrics.measure import AUC_FRACTION
from regkit.report.labels import label
from regkit.report.plot import Ink, Plot, canvas, legend_above, styled
from regkit.report.run import Run
from regkit.system.arrays import Array

if TYPE_CHECKING:
    from matplotlib.figure import Figure

STEPS = 61
KINDS = {"raw": "raw", "adjusted": "adjusted"}


def threshold_curves(run: Run) -> Plot | None:
    """Returns the plot of the percentage of all joints within a threshold, for each method."""
    sizes = [r.size for by in run.records.values() for r in by.values() if r.errors is not None]
    if not sizes:
        return None
    widest = AUC_FRACTION * max(sizes)
    thresholds = np.linspace(0.0, widest, STEPS)
    curves = {
        (method, kind): curve
        for method in run.records
        for kind in KINDS
        if (curve := _curve(run, method, kind, thresholds)) is not None
    }
    if not curves:
        return None
    near = 100.0 * PCK_FRACTION * max(sizes)
    caption = (
        "The percentage of joints, over all frames of all recordings, whose error is within a "
        f"threshold, up to {100 * AUC_FRACTION:.0f} % of the body's size; the vertical line is the "
        f"PCK threshold of {100 * PCK_FRACTION:.0f} % ({near:.3g} cm). Higher is better."
    ) + run.not_drawn

    def draw(ink: Ink) -> Figure:
        return _drawn(run, thresholds, curves, near, ink)

    rows = [
        [100.0 * float(x), *(float(curve[index]) for curve in curves.values())]
        for index, x in enumerate(thresholds)
    ]
    return Plot(
        name="thresholds",
        title="Thresholds",
        caption=caption,
        alt=f"Rising curves. {caption} The numbers are in thresholds.csv.",
        draw=draw,
        columns=["threshold [cm]", *(f"{method} {kind} [%]" for method, kind in curves)],
        rows=rows,
    )


def _curve(run: Run, method: str, kind: str, thresholds: Array) -> Array | None:
    errors = [record.errors for record in run.records[method].values()]
    distances = [
        (one.raw if kind == "raw" else one.adjusted).ravel() for one in errors if one is not None
    ]
    if not distances or not np.isfinite(together := np.concatenate(distances)).any():
        return None
    return np.array([100.0 * float(fraction_within(together, x)) for x in thresholds])


def _drawn(
    run: Run, thresholds: Array, curves: dict[tuple[str, str], Array], near: float, ink: Ink
) -> Figure:
    kinds = [kind for kind in KINDS if any(of == kind for _, of in curves)]
    figure = canvas(ink, 3.1)
    grid = figure.subplots(1, len(kinds), sharey=True, squeeze=False)[0]
    for axes, kind in zip(grid, kinds, strict=True):
        styled(axes, ink, grid="y")
        axes.set_title(KINDS[kind], color=ink.text, fontsize=9)
        axes.axvline(near, color=ink.faint, linewidth=1.0)
        for (method, of), curve in curves.items():
            if of != kind or method not in run.drawn:
                continue
            style = run.style(method)
            axes.plot(
                100.0 * thresholds,
                curve,
                color=style.colour,
                linestyle=style.dash,
                linewidth=1.6,
                marker=style.marker,
                markersize=4.0,
                markevery=(3, 12),
                label=label(method) if kind == kinds[0] else None,
            )
        axes.set_xlim(0.0, 100.0 * float(thresholds[-1]))
        axes.set_ylim(0.0, 101.0)
        axes.set_xlabel("threshold [cm]")
    grid[0].set_ylabel("joints within threshold [%]")
    legend_above(figure, ink)
    return figure
