"""The figure of the shape models in front view: projected densities, outlines or points."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from regkit.report.frame_drawing import DrawnPrimitives, FrameDrawing
from regkit.report.outlines import outlines
from regkit.report.plot import WIDTH, Ink, Plot, Value, canvas, styled
from regkit.report.run import Run
from regkit.system.arrays import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST = 4
"""Maximum number of shape models side by side."""

FRONT = (0, 1)
"""The horizontal and the vertical axis of the front view, in the camera frame."""

PIXELS = 260
"""Resolution of the longer side of a density."""


def densities(run: Run) -> Plot | None:
    """Returns the plot of each shape model in the first frame of one recording."""
    drawings = _drawings(run)
    if not drawings:
        return None
    recording, by_shape = drawings
    dense = [
        shape for shape, (_, drawing) in by_shape.items() if drawing.primitives.kind == "gaussians"
    ]
    caption = (
        f"The shape models in the poses found in the first frame of {recording}, from the front"
    )
    if dense:
        caption += f": of {' and '.join(dense)} the sum of the Gaussians along the line of sight"
    caption += "; " + ", ".join(
        f"{shape} has {len(drawing.primitives.centres)} {_called(drawing.primitives)}"
        for shape, (_, drawing) in by_shape.items()
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
            row
            for shape, (method, drawing) in by_shape.items()
            for row in _rows(shape, method, drawing)
        ],
    )


def projected(primitives: DrawnPrimitives, across: Array, down: Array) -> Array:
    """Returns the sum of Gaussians integrated along z [m] on a grid, (len(down), len(across)).

    The integral of exp(-1/2 d^T C^-1 d) along z is exp(-1/2 d_xy^T C_xy^-1 d_xy) times
    sqrt(2 pi |C| / |C_xy|), where C_xy is the upper left block of C.

    Args:
        primitives: Gaussians.
        across: x of the grid's columns [m].
        down: y of the grid's rows [m].
    """
    total = np.zeros((len(down), len(across)))
    for weight, centre, covariance in zip(
        primitives.weights, primitives.centres, primitives.covariances(), strict=True
    ):
        flat = covariance[:2, :2]
        precision = np.linalg.inv(flat)
        depth = np.sqrt(2.0 * np.pi * np.linalg.det(covariance) / np.linalg.det(flat))
        x, y = across[None, :] - centre[0], down[:, None] - centre[1]
        exponent = precision[0, 0] * x**2 + 2.0 * precision[0, 1] * x * y + precision[1, 1] * y**2
        total += weight * depth * np.exp(-0.5 * exponent)
    return total


def _drawings(run: Run) -> tuple[str, dict[str, tuple[str, FrameDrawing]]] | None:
    """Returns the recording with most shape models, and each one's first method and drawing."""
    best: tuple[str, dict[str, tuple[str, FrameDrawing]]] | None = None
    for recording in run.recordings:
        by_shape: dict[str, tuple[str, FrameDrawing]] = {}
        for method, records in run.records.items():
            if recording in records and len(by_shape) < MOST:
                by_shape.setdefault(
                    run.style(method).shape, (method, records[recording].drawings[0])
                )
        if by_shape and (best is None or len(by_shape) > len(best[1])):
            best = recording, by_shape
    return best


def _called(primitives: DrawnPrimitives) -> str:
    return {"gaussians": "Gaussians", "capsules": "capsules"}.get(primitives.kind, "points shown")


def _rows(shape: str, method: str, drawing: FrameDrawing) -> list[list[Value]]:
    primitives = drawing.primitives
    known = len(primitives.scales) > 0
    return [
        [
            shape,
            method,
            *map(float, centre),
            *(map(float, primitives.scales[index]) if known else (None, None, None)),
            float(primitives.weights[index]) if known else None,
        ]
        for index, centre in enumerate(primitives.centres)
    ]


def _drawn(by_shape: dict[str, tuple[str, FrameDrawing]], ink: Ink) -> Figure:
    drawings = [drawing for _, drawing in by_shape.values()]
    reach = max(_reach(drawing.primitives) for drawing in drawings)
    points = np.concatenate([drawing.primitives.centres for drawing in drawings])
    low, high = points.min(axis=0)[:2] - reach, points.max(axis=0)[:2] + reach
    sides = high - low
    width = WIDTH / max(2, len(drawings))
    figure = canvas(ink, min(5.5, 0.55 + width * float(sides[1] / sides[0])))
    grid = figure.subplots(1, len(drawings), sharex=True, sharey=True, squeeze=False)[0]
    step = float(sides.max()) / PIXELS
    across, down = np.arange(low[0], high[0], step), np.arange(low[1], high[1], step)
    for axes, (shape, (method, drawing)) in zip(grid, by_shape.items(), strict=True):
        styled(axes, ink)
        _picture(axes, drawing.primitives, across, down, ink)
        title = shape if shape == method else f"{shape} ({method})"
        axes.set_title(title, color=ink.text, fontsize=9)
        axes.set_aspect("equal")
        axes.set_xlabel("x [m]")
        axes.locator_params(axis="x", nbins=3)
    grid[0].set_xlim(low[0], high[0])
    grid[0].set_ylim(high[1], low[1])
    grid[0].set_ylabel("y [m]")
    return figure


def _picture(axes: Axes, primitives: DrawnPrimitives, across: Array, down: Array, ink: Ink) -> None:
    if primitives.kind == "gaussians":
        axes.imshow(
            projected(primitives, across, down),
            cmap="cividis",
            extent=(across[0], across[-1], down[-1], down[0]),
            interpolation="bilinear",
        )
        return
    axes.set_facecolor(ink.faint if primitives.kind == "points" else ink.paper)
    if primitives.kind == "capsules":
        for line in outlines(primitives, FRONT):
            axes.fill(*line, facecolor=ink.text, alpha=0.75, linewidth=0)
    else:
        axes.set_facecolor(ink.paper)
        axes.scatter(
            primitives.centres[:, 0], primitives.centres[:, 1], s=2, color=ink.text, linewidths=0
        )


def _reach(primitives: DrawnPrimitives) -> float:
    """Returns the largest extent of primitives beyond their centres [m]."""
    if primitives.kind == "gaussians":
        return 2.5 * float(primitives.scales.max())
    if primitives.kind == "capsules":
        return float((primitives.halves + primitives.radii.max(axis=1)).max())
    return 0.05 * float(np.ptp(primitives.centres, axis=0).max() or 1.0)
