"""Bar charts of each recording, grouped by method."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from regkit.report.labels import BY_NAME, NAMES, axis_label, counted, label
from regkit.report.plot import Ink, Plot, canvas, legend_above, styled
from regkit.report.run import Run

if TYPE_CHECKING:
    from matplotlib.figure import Figure

BAR = 0.13
"""Height of a bar [in] for few recordings."""

MOST = 60
"""Maximum number of recordings that are drawn, those with the largest values."""


def recording_bars(run: Run) -> Plot | None:
    """Returns the plot of the ranking metric of all methods on all recordings."""
    if run.shape_pairs and set(run.shape_pairs[0]) == set(run.finished):
        return None  # The plot of two shape models shows the same.
    return _bars(
        run,
        run.drawn,
        "recordings",
        "Each recording",
        f"The {NAMES[run.metric]} of every method on every recording. Shorter is better; a missing "
        f"bar means that the recording failed or was not run.{run.not_drawn}",
    )


def shape_bars(run: Run) -> Plot | None:
    """Returns the paper's plot of two methods that differ in their shape model only."""
    if not run.shape_pairs:
        return None
    one, other = run.shape_pairs[0]
    values = [(run.value(one, s), run.value(other, s)) for s in run.recordings]
    both = [(a, b) for a, b in values if a is not None and b is not None]
    if not both:
        return None
    won = sum(a < b for a, b in both)
    return _bars(
        run,
        [one, other],
        "shapes",
        "Two shape models",
        f"The {NAMES[run.metric]} of {_named(run, one)} and {_named(run, other)}, which differ in "
        f"the shape model only: it is smaller with {one} in {won} of "
        f"{counted(len(both), 'recording')}.",
    )


def _named(run: Run, method: str) -> str:
    """Returns the name of a method, with its shape model if that differs from the name."""
    shape = run.style(method).shape
    return method if shape == method else f"{method} (shape model {shape})"


def _bars(run: Run, methods: Sequence[str], name: str, title: str, caption: str) -> Plot | None:
    rows = [[s, *(run.value(method, s) for method in methods)] for s in run.recordings]
    rows = [row for row in rows if any(value is not None for value in row[1:])]
    if not rows:
        return None
    unit, shown = BY_NAME[run.metric].unit, rows
    if len(rows) > MOST:
        largest = {row[0]: max(float(one) for one in row[1:] if one is not None) for row in rows}
        worst = set(sorted(largest, key=lambda name: -largest[name])[:MOST])
        shown = [row for row in rows if row[0] in worst]
        caption += f" Of {len(rows)} recordings the {MOST} with the largest values are drawn."

    def draw(ink: Ink) -> Figure:
        return _drawn(run, methods, shown, ink)

    return Plot(
        name=name,
        title=title,
        caption=caption,
        alt=f"Horizontal bars. {caption} The numbers are in {name}.csv.",
        draw=draw,
        columns=["recording", *(f"{method} [{unit}]" for method in methods)],
        rows=rows,
    )


def _drawn(
    run: Run, methods: Sequence[str], rows: Sequence[Sequence[str | float | None]], ink: Ink
) -> Figure:
    thickness = max(0.06, BAR if len(rows) < 12 else 0.09)
    height = 0.9 + len(rows) * (thickness * len(methods) + 0.1)
    figure = canvas(ink, max(1.6, height))
    axes = styled(figure.add_subplot(), ink, grid="x")
    each = 0.84 / len(methods)
    for number, method in enumerate(methods):
        style = run.style(method)
        known = [(i, float(row[number + 1] or 0.0)) for i, row in enumerate(rows)
                 if row[number + 1] is not None]  # fmt: skip
        axes.barh(
            [index - 0.42 + (number + 0.5) * each for index, _ in known],
            [value for _, value in known],
            height=0.92 * each,
            color=style.colour,
            hatch=style.hatch,
            edgecolor=ink.paper,
            linewidth=0.0,
            label=label(method),
        )
    axes.set_yticks(range(len(rows)), [label(str(row[0])) for row in rows])
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel(axis_label(run.metric))
    legend_above(figure, ink)
    return figure
