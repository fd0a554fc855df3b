"""The figure of the time per frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from regkit.report.labels import label, wrapped
from regkit.report.plot import NAME, Ink, Plot, canvas, legend_above, styled
from regkit.report.run import Run

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def timing_split(run: Run) -> Plot | None:
    """Returns the plot of the mean time per frame, split into preprocessing and registration."""
    rows: list[tuple[str, float, float, float]] = []
    for method, by_recording in run.records.items():
        records = list(by_recording.values())
        if not records:
            continue
        preprocessing = np.concatenate([record.preprocessing for record in records])
        seconds = np.concatenate([record.seconds for record in records])
        evaluations = np.concatenate([record.evaluations for record in records])
        rows.append(
            (
                method,
                1000.0 * float(preprocessing.mean()),
                1000.0 * float((seconds - preprocessing).mean()),
                float(evaluations.mean()),
            )
        )
    if not rows:
        return None
    caption = (
        "The mean time per frame for preprocessing (pale) and registration, and the number of "
        "energy evaluations; reading files is not included."
    )

    def draw(ink: Ink) -> Figure:
        return _drawn(run, rows, ink)

    return Plot(
        name="timing",
        title="Time",
        caption=caption,
        alt=f"Stacked horizontal bars. {caption} The numbers are in timing.csv.",
        draw=draw,
        columns=["method", "preprocessing [ms]", "registering [ms]", "evaluations per frame"],
        rows=rows,
    )


def _drawn(run: Run, rows: list[tuple[str, float, float, float]], ink: Ink) -> Figure:
    from matplotlib.patches import Patch

    figure = canvas(ink, 0.95 + 0.3 * len(rows))
    axes = styled(figure.add_subplot(), ink, grid="x")
    widest = max(preprocessing + registering for _, preprocessing, registering, _ in rows)
    for place, (method, preprocessing, registering, evaluations) in enumerate(rows):
        style = run.style(method)
        axes.barh(place, preprocessing, height=0.6, color=style.colour, alpha=0.4, linewidth=0)
        axes.barh(
            place,
            registering,
            left=preprocessing,
            height=0.6,
            color=style.colour,
            hatch=style.hatch,
            edgecolor=ink.paper,
            linewidth=0,
        )
        total = preprocessing + registering
        # Methods of other libraries do not report evaluations.
        evaluated = f", {_rounded(evaluations)} evaluations" if evaluations else ""
        text = f"{_rounded(total)} ms{evaluated}"
        axes.text(
            total + 0.01 * widest, place, text, va="center", color=ink.text, fontsize=8.5
        )  # fmt: skip
    axes.set_yticks(range(len(rows)), [wrapped(label(method), NAME) for method, *_ in rows])
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.set_xlim(0.0, 1.5 * widest)
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel("time per frame [ms]")
    handles = [
        Patch(facecolor=ink.text, alpha=0.35, label="preprocessing"),
        Patch(facecolor=ink.text, label="registering"),
    ]
    legend_above(figure, ink, handles)
    return figure


def _rounded(value: float) -> str:
    """Returns a number with two or three significant digits."""
    return f"{value:.0f}" if value >= 10.0 else f"{value:.1f}"
