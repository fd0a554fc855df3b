"""Pictures of what segmenters remove from frames."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from regkit.report.plot import LIGHT, canvas, inked, styled
from regkit.report.style import PALETTE
from regkit.tracking.preview import PreviewedFrame

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LEFT = "#222222"
"""Colour of points that are left."""

UNKNOWN = "#B9B9B9"
"""Colour of pixels that something may hide."""

WIDTH, HEIGHT = 3.4, 2.5
"""Size of a picture [in]."""

MAX_POINTS = 20_000
"""Maximum number of points of a cloud in a picture."""


def preview_figure(title: str, frames: Sequence[PreviewedFrame]) -> Figure:
    """Returns a figure with a row for each frame: what each step removes, and what is left.

    Args:
        title: Title of the figure.
        frames: The frames, with the same steps.
    """
    figure = canvas(LIGHT, 0.7 + HEIGHT * len(frames), width=2 * WIDTH)
    figure.suptitle(title, fontsize=10, color=LIGHT.text)
    grid = figure.subplots(len(frames), 2, squeeze=False)
    for (removed, left), frame in zip(grid, frames, strict=True):
        for axes in (removed, left):
            styled(axes, LIGHT).set_axis_off()
        gone = len(frame.whole.points) - frame.counts[-1]
        removed.set_title(f"frame {frame.index}: {gone} points removed", fontsize=8)
        left.set_title(f"{frame.counts[-1]} left", fontsize=8)
        draw = _draw_cloud if frame.whole.pixels is None else _draw_image
        draw(removed, left, frame)
    _add_legend(figure, frames)
    return figure


def _draw_image(removed: Axes, left: Axes, frame: PreviewedFrame) -> None:
    from matplotlib.colors import to_rgb

    depth, pixels = frame.whole.depth, frame.whole.pixels
    assert depth is not None
    assert pixels is not None
    colours = np.array([to_rgb(colour) for colour in _colours(frame)])
    # Nearer is darker, so that shapes remain visible within a colour.
    z = frame.whole.points[:, 2]
    near, far = np.percentile(z, [2.0, 98.0])
    shade = 0.65 * np.clip((z - near) / max(far - near, 1e-9), 0.0, 1.0)[:, None]
    image = np.ones((depth.size, 3))
    image[pixels] = colours[frame.removed_by] * (1.0 - shade) + shade
    removed.imshow(image.reshape(*depth.shape, 3))
    kept = frame.removed_by == len(frame.steps)
    image = np.ones((depth.size, 3))
    if frame.left.depth is not None:
        image[np.isnan(frame.left.depth).ravel()] = to_rgb(UNKNOWN)
    image[pixels[kept]] = (colours[-1] * (1.0 - shade) + shade)[kept]
    left.imshow(image.reshape(*depth.shape, 3))


def _draw_cloud(removed: Axes, left: Axes, frame: PreviewedFrame) -> None:
    step = max(1, len(frame.whole.points) // MAX_POINTS)
    points, by = frame.whole.points[::step], frame.removed_by[::step]
    colours = np.array(_colours(frame))[by]
    kept = by == len(frame.steps)
    for axes, some in ((removed, np.ones_like(kept)), (left, kept)):
        axes.scatter(points[some, 0], points[some, 1], s=1, c=colours[some], linewidths=0)
        axes.set_aspect("equal")
        axes.invert_yaxis()


def _colours(frame: PreviewedFrame) -> list[str]:
    """Returns the colours of the steps, and of what is left."""
    return [*(PALETTE[step % len(PALETTE)] for step in range(len(frame.steps))), LEFT]


def _add_legend(figure: Figure, frames: Sequence[PreviewedFrame]) -> None:
    from matplotlib.patches import Patch

    names = [*(f"removed by {name}" for name in frames[0].steps), "kept"]
    handles = [
        Patch(color=colour, label=name)
        for colour, name in zip(_colours(frames[0]), names, strict=True)
    ]
    handles.append(Patch(color=UNKNOWN, label="unknown: may hide the body"))
    legend = figure.legend(
        handles=handles, loc="outside lower center", ncols=min(3, len(handles)), fontsize=8
    )
    inked(legend, LIGHT)
