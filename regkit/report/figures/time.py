"""The figure of the error over time, with the frames in which bodies were lost."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from regkit.report.labels import label
from regkit.report.plot import Ink, Plot, Value, canvas, legend_above, styled
from regkit.report.record import Record
from regkit.report.run import Run
from regkit.system.arrays import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST = 6
"""Maximum number of recordings that are drawn, those with the largest errors."""


def errors_over_time(run: Run) -> Plot | None:
    """Returns the plot of each frame's mean joint error, or else distance to the surface."""
    joints = run.metric == "joint_error_raw_cm"
    curves: dict[str, dict[str, Array]] = {}
    for method, by_recording in run.records.items():
        for recording, record in by_recording.items():
            curve = _curve(record, joints)
            if curve is not None and np.isfinite(curve).any():
                curves.setdefault(recording, {})[method] = curve
    if not curves:
        return None
    drawn = {
        recording: shown
        for recording, by in curves.items()
        if (shown := {method: by[method] for method in run.drawn if method in by})
    }
    worst = sorted(
        drawn, key=lambda name: -max(float(np.nanmean(c)) for c in drawn[name].values())
    )[:MOST]
    drawn = {name: drawn[name] for name in run.recordings if name in worst}
    what = "mean joint error" if joints else "median distance of the data to the surface"
    chosen = f", in the {MOST} recordings with the largest" if len(curves) > MOST else ""
    caption = (
        f"The {what} of each frame{chosen}"
        + (
            "; bars below the axis mark frames in which a method lost the body (less than half of "
            "the joints within the PCK threshold)."
            if joints
            else "; bars below the axis mark frames in which the data say that the body is lost."
        )
        + (
            " A dotted line is the distance within which a method expects a joint in 9 of 10 cases."
            if joints and _sure(run)
            else ""
        )
        + run.not_drawn
    )
    unit = "cm" if joints else "mm"

    def draw(ink: Ink) -> Figure:
        return _drawn(run, drawn, f"error [{unit}]", ink)

    rows: list[list[Value]] = []
    for recording, by_method in curves.items():
        for method, curve in by_method.items():
            record = run.records[method][recording]
            lost, shares, verdicts = record.losses.lost, record.inlier_shares, record.verdicts
            rows += [
                [recording, method, frame, frame / record.fps, float(value), int(lost[frame]),
                 100.0 * float(shares[frame]), str(verdicts[frame])]
                for frame, value in enumerate(curve)
            ]  # fmt: skip
    return Plot(
        name="over_time",
        title="Over time",
        caption=caption,
        alt=f"Curves over time, one panel for each recording. {caption} The numbers of all "
        "recordings are in over_time.csv.",
        draw=draw,
        columns=[
            "recording",
            "method",
            "frame",
            "time [s]",
            f"{what} [{unit}]",
            "lost",
            "inliers [%]",
            "verdict",
        ],
        rows=rows,
    )


def _sure(run: Run) -> bool:
    """Returns whether some method knows how sure it is."""
    records = [one for by_recording in run.records.values() for one in by_recording.values()]
    return any(one.errors is not None and one.errors.deviations is not None for one in records)


def _curve(record: Record, joints: bool) -> Array | None:
    if not joints:
        return 1000.0 * record.surface_distances
    if record.errors is None:
        return None
    raw = record.errors.raw
    known = np.isfinite(raw)
    sums = np.where(known, raw, 0.0).sum(axis=1)
    return np.asarray(
        np.where(known.any(axis=1), 100.0 * sums / np.maximum(known.sum(axis=1), 1), np.nan)
    )


def _drawn(run: Run, curves: dict[str, dict[str, Array]], what: str, ink: Ink) -> Figure:
    figure = canvas(ink, 0.7 + 1.45 * len(curves))
    grid = figure.subplots(len(curves), 1, squeeze=False)[:, 0]
    methods = [name for name in run.records if any(name in by for by in curves.values())]
    for axes, (recording, by_method) in zip(grid, curves.items(), strict=True):
        styled(axes, ink, grid="y")
        axes.set_title(label(recording), loc="left", color=ink.text, fontsize=9)
        for method, curve in by_method.items():
            style = run.style(method)
            _expected(axes, run.records[method][recording], style.colour, what)
            seconds = np.arange(len(curve)) / run.records[method][recording].fps
            axes.plot(
                seconds, curve, color=style.colour, linestyle=style.dash, linewidth=1.2,
                marker=style.marker if len(curve) < 4 else None, markersize=4,
            )  # fmt: skip
        _shade(axes, run, recording, list(by_method))
        axes.set_ylabel(what)
    grid[-1].set_xlabel("time [s]")
    handles = [
        grid[0].plot([], [], color=run.style(name).colour, linestyle=run.style(name).dash,
                     label=label(name))[0]
        for name in methods
    ]  # fmt: skip
    legend_above(figure, ink, handles)
    return figure


def _expected(axes: Axes, record: Record, colour: str, what: str) -> None:
    """Draws what the method itself expects of the joint errors, if it knows.

    It is a line: areas of several methods would hide each other.
    """
    expected = None if record.errors is None else record.errors.expected()
    if expected is None or "cm" not in what:
        return
    seconds = np.arange(len(expected)) / record.fps
    axes.plot(seconds, 100.0 * expected, color=colour, linestyle=":", linewidth=1.0, alpha=0.7)


def _shade(axes: Axes, run: Run, recording: str, methods: list[str]) -> None:
    """Draws a strip below zero for each method that lost the body, in its colour."""
    top = axes.get_ylim()[1]
    lost = [
        (method, losses.intervals())
        for method in methods
        if (losses := run.records[method][recording].losses).lost.any()
    ]
    strip = 0.07 * top
    for row, (method, intervals) in enumerate(lost):
        style, fps = run.style(method), run.records[method][recording].fps
        for first, end in intervals:
            span = (first - 0.5) / fps, (end - first) / fps
            axes.broken_barh([span], (-(row + 1.0) * strip, 0.8 * strip), color=style.colour,
                             linewidth=0)  # fmt: skip
            axes.axvspan(span[0], span[0] + span[1], color=style.colour, alpha=0.08, linewidth=0)
    axes.set_ylim(-(len(lost) + 0.3) * strip if lost else 0.0, top)
