"""The figure of the error of each joint."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from regkit.metrics import JointErrors
from regkit.report.labels import label
from regkit.report.plot import Ink, Plot, canvas, legend_above, styled
from regkit.report.run import Run

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def joint_means(errors: list[JointErrors], kind: str) -> dict[str, float]:
    """Returns the mean error [cm] of each joint over all frames in which it is known.

    Args:
        errors: Joint errors of several recordings.
        kind: ``raw`` or ``adjusted``.
    """
    sums: dict[str, tuple[float, int]] = {}
    for one in errors:
        distances = one.raw if kind == "raw" else one.adjusted
        known = np.isfinite(distances)
        for index, joint in enumerate(one.joints):
            total, count = sums.get(joint, (0.0, 0))
            column = distances[known[:, index], index]
            sums[joint] = total + float(column.sum()), count + len(column)
    return {joint: 100.0 * total / count for joint, (total, count) in sums.items() if count}


def errors_of(run: Run, method: str) -> list[JointErrors]:
    """Returns the joint errors of a method on each recording that has them."""
    records = run.records.get(method, {}).values()
    return [record.errors for record in records if record.errors is not None]


def joint_dots(run: Run) -> Plot | None:
    """Returns the plot of each joint's mean raw error, by method; None without joint errors."""
    means = {method: joint_means(errors_of(run, method), "raw") for method in run.records}
    means = {method: by_joint for method, by_joint in means.items() if by_joint}
    joints = list(dict.fromkeys(joint for by_joint in means.values() for joint in by_joint))
    if len(joints) < 2:
        return None
    caption = (
        "The mean error of each joint over all frames of all recordings, sorted by the mean over "
        f"all methods with the worst joint at the top.{run.not_drawn}"
    )
    joints.sort(key=lambda name: -float(np.mean([by[name] for by in means.values() if name in by])))

    def draw(ink: Ink) -> Figure:
        return _drawn(run, joints, means, ink)

    adjusted = {method: joint_means(errors_of(run, method), "adjusted") for method in means}
    return Plot(
        name="joints",
        title="Each joint",
        caption=caption,
        alt=f"A row of points for each joint. {caption} The numbers are in joints.csv.",
        draw=draw,
        columns=[
            "joint",
            *(f"{method} {kind} [cm]" for method in means for kind in ("raw", "adjusted")),
        ],
        rows=[
            [joint, *(of[method].get(joint) for method in means for of in (means, adjusted))]
            for joint in joints
        ],
    )


def _drawn(run: Run, joints: list[str], means: dict[str, dict[str, float]], ink: Ink) -> Figure:
    figure = canvas(ink, 0.9 + 0.17 * len(joints))
    axes = styled(figure.add_subplot(), ink, grid="y")
    means = {method: means[method] for method in run.drawn if method in means}
    for method, by_joint in means.items():
        style = run.style(method)
        known = [(index, by_joint[name]) for index, name in enumerate(joints) if name in by_joint]
        axes.plot(
            [value for _, value in known],
            [index for index, _ in known],
            linestyle="",
            marker=style.marker,
            markersize=5.0,
            color=style.colour,
            alpha=0.9,
            label=label(method),
        )
    axes.set_yticks(range(len(joints)), [label(joint) for joint in joints])
    axes.set_ylim(len(joints) - 0.5, -0.5)
    largest = max(value for by_joint in means.values() for value in by_joint.values())
    axes.set_xlim(0.0, 1.04 * largest or 1.0)
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel("mean joint error [cm]")
    legend_above(figure, ink)
    return figure
