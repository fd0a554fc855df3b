"""The shape models as a camera would see them: projected densities, silhouettes, points."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from regkit.report.look import Form, Look
from regkit.report.outlines import outlines
from regkit.report.plot import WIDTH, Ink, Plot, Value, canvas, styled
from regkit.report.run import Run
from regkit.system.arrays import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST = 4
"""So many shape models are shown side by side."""

FRONT = (0, 1)
"""The axes of the camera's frame that are seen from the front."""

PIXELS = 260
"""Of a density's longer side."""


def densities(run: Run) -> Plot | None:
    """One look at each shape model, in the first frame of one recording."""
    looks = _looks(run)
    if not looks:
        return None
    recording, by_shape = looks
    dense = [shape for shape, (_, look) in by_shape.items() if look.form.kind == "gaussians"]
    caption = (
        f"The shape models in the poses found in the first frame of {recording}, from the front"
    )
    if dense:
        caption += f": of {' and '.join(dense)} the sum of the Gaussians along the line of sight"
    caption += "; " + ", ".join(
        f"{shape} has {len(look.form.centres)} {_called(look.form)}"
        for shape, (_, look) in by_shape.items()
    )

    def draw(ink: Ink) -> Figure:
        return _drawn(by_shape, ink)

    return Plot(
        name="densities",
        title="Shape models",
        caption=caption + ".",
        alt=f"Pictures side by side. {caption}. Their primitives are in densities.csv.",
        draw=draw,
        columns=[
            "shape model",
            "method",
            "x [m]",
            "y [m]",
            "z [m]",
            "scale 1 [m]",
            "scale 2 [m]",
            "scale 3 [m]",
            "weight",
        ],
        rows=[
            row for shape, (method, look) in by_shape.items() for row in _rows(shape, method, look)
        ],
    )


def projected(form: Form, across: Array, down: Array) -> Array:
    """The Gaussians' sum integrated along z [m] on a grid, (len(down), len(across)).

    The integral of exp(-1/2 d^T C^-1 d) along z is that of the covariance's upper left block, times
    sqrt(2 pi |C| / |C_xy|).
    """
    total = np.zeros((len(down), len(across)))
    for weight, centre, covariance in zip(
        form.weights, form.centres, form.covariances(), strict=True
    ):
        flat = covariance[:2, :2]
        precision = np.linalg.inv(flat)
        depth = np.sqrt(2.0 * np.pi * np.linalg.det(covariance) / np.linalg.det(flat))
        x, y = across[None, :] - centre[0], down[:, None] - centre[1]
        exponent = precision[0, 0] * x**2 + 2.0 * precision[0, 1] * x * y + precision[1, 1] * y**2
        total += weight * depth * np.exp(-0.5 * exponent)
    return total


def _looks(run: Run) -> tuple[str, dict[str, tuple[str, Look]]] | None:
    """The recording that most shape models finished, and the first method and look of each."""
    best: tuple[str, dict[str, tuple[str, Look]]] | None = None
    for recording in run.recordings:
        by_shape: dict[str, tuple[str, Look]] = {}
        for method, records in run.records.items():
            if recording in records and len(by_shape) < MOST:
                by_shape.setdefault(run.style(method).shape, (method, records[recording].looks[0]))
        if by_shape and (best is None or len(by_shape) > len(best[1])):
            best = recording, by_shape
    return best


def _called(form: Form) -> str:
    return {"gaussians": "Gaussians", "capsules": "capsules"}.get(form.kind, "points shown")


def _rows(shape: str, method: str, look: Look) -> list[list[Value]]:
    form = look.form
    known = len(form.scales) > 0
    return [
        [
            shape,
            method,
            *map(float, centre),
            *(map(float, form.scales[index]) if known else (None, None, None)),
            float(form.weights[index]) if known else None,
        ]
        for index, centre in enumerate(form.centres)
    ]


def _drawn(by_shape: dict[str, tuple[str, Look]], ink: Ink) -> Figure:
    looks = [look for _, look in by_shape.values()]
    reach = max(_reach(look.form) for look in looks)
    points = np.concatenate([look.form.centres for look in looks])
    low, high = points.min(axis=0)[:2] - reach, points.max(axis=0)[:2] + reach
    sides = high - low
    width = WIDTH / max(2, len(looks))
    figure = canvas(ink, min(5.5, 0.55 + width * float(sides[1] / sides[0])))
    grid = figure.subplots(1, len(looks), sharex=True, sharey=True, squeeze=False)[0]
    step = float(sides.max()) / PIXELS
    across, down = np.arange(low[0], high[0], step), np.arange(low[1], high[1], step)
    for axes, (shape, (method, look)) in zip(grid, by_shape.items(), strict=True):
        styled(axes, ink)
        _picture(axes, look.form, across, down, ink)
        title = shape if shape == method else f"{shape} ({method})"
        axes.set_title(title, color=ink.text, fontsize=9)
        axes.set_aspect("equal")
        axes.set_xlabel("x [m]")
        axes.locator_params(axis="x", nbins=3)
    grid[0].set_xlim(low[0], high[0])
    grid[0].set_ylim(high[1], low[1])
    grid[0].set_ylabel("y [m]")
    return figure


def _picture(axes: Axes, form: Form, across: Array, down: Array, ink: Ink) -> None:
    if form.kind == "gaussians":
        axes.imshow(
            projected(form, across, down),
            cmap="cividis",
            extent=(across[0], across[-1], down[-1], down[0]),
            interpolation="bilinear",
        )
        return
    axes.set_facecolor(ink.faint if form.kind == "points" else ink.paper)
    if form.kind == "capsules":
        for line in outlines(form, FRONT):
            axes.fill(*line, facecolor=ink.text, alpha=0.75, linewidth=0)
    else:
        axes.set_facecolor(ink.paper)
        axes.scatter(form.centres[:, 0], form.centres[:, 1], s=2, color=ink.text, linewidths=0)


def _reach(form: Form) -> float:
    """How far primitives reach beyond their centres [m]."""
    if form.kind == "gaussians":
        return 2.5 * float(form.scales.max())
    if form.kind == "capsules":
        return float((form.halves + form.radii.max(axis=1)).max())
    return 0.05 * float(np.ptp(form.centres, axis=0).max() or 1.0)
