"""Where the time goes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from regkit.report.plot import NAME, Ink, Plot, canvas, legend_above, styled
from regkit.report.run import Run
from regkit.report.words import broken, label

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def timing_split(run: Run) -> Plot | None:
    """The mean time of a frame, split into preprocessing and registering."""
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
        "The mean time of a frame: to make data of it (pale) and to register it, and how often the "
        "energy was evaluated for it; reading files is not counted."
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
        # Methods of other libraries do not count them.
        counted = f", {_rounded(evaluations)} evaluations" if evaluations else ""
        told = f"{_rounded(total)} ms{counted}"
        axes.text(
            total + 0.01 * widest, place, told, va="center", color=ink.text, fontsize=8.5
        )  # fmt: skip
    axes.set_yticks(range(len(rows)), [broken(label(method), NAME) for method, *_ in rows])
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.set_xlim(0.0, 1.5 * widest)
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel("time of a frame [ms]")
    handles = [
        Patch(facecolor=ink.text, alpha=0.35, label="preprocessing"),
        Patch(facecolor=ink.text, label="registering"),
    ]
    legend_above(figure, ink, handles)
    return figure


def _rounded(value: float) -> str:
    """A number with two or three digits that count."""
    return f"{value:.0f}" if value >= 10.0 else f"{value:.1f}"
