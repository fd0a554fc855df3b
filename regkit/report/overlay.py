"""Pictures of a body over the points that it was registered to."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import ConvexHull

from regkit.arrays import Array
from regkit.body import Body
from regkit.files import replacing
from regkit.interfaces import Registrar
from regkit.observation import Truth
from regkit.primitives import Gaussians, Primitives, TaperedCapsules, Volumes
from regkit.skeleton import Placement
from regkit.tracking import Track, TrackedFrame

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MANY = 300
"""More outlines than this would only hide each other."""

_CIRCLE = 2.0 * np.array(
    [np.cos(np.linspace(0, 2 * np.pi, 49)), np.sin(np.linspace(0, 2 * np.pi, 49))]
)
_VIEWS = {"from the front": (0, 1), "from its left": (2, 1)}
"""The two axes of the camera's frame that a view shows, to the right and down."""


def draw_overlay(
    path: Path,
    title: str,
    frames: Sequence[TrackedFrame],
    track: Track,
    registrar: Registrar,
    truth: Truth | None,
) -> None:
    """Draw the ``overlay`` to a file."""
    with replacing(path) as temporary:
        figure = overlay(title, frames, track, registrar, truth)
        figure.savefig(temporary, dpi=110, metadata={"Software": None})


def overlay(
    title: str,
    frames: Sequence[TrackedFrame],
    track: Track,
    registrar: Registrar,
    truth: Truth | None,
) -> Figure:
    """The first, the worst and the last frame from the front and from the side.

    Gaussians are drawn as the outlines of their 2-sigma ellipsoids, capsules and spheres as their
    own, what is a point or one of very many as dots, reference joints as crosses.
    The worst frame is the one whose points lie farthest from the body's surface.
    """
    # The object interface needs no display and leaves no global state behind.
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    chosen = {0: "first", len(frames) - 1: "last"}
    if np.isfinite(track.surface_distances).all():
        worst = int(np.argmax(track.surface_distances))
        chosen[worst] = f"{chosen[worst]}, worst" if worst in chosen else "worst"
    figure = Figure(figsize=(2.9 * len(chosen), 7.2), layout="constrained", facecolor="white")
    FigureCanvasAgg(figure)
    figure.suptitle(title)
    grid = figure.subplots(len(_VIEWS), len(chosen), squeeze=False)
    for column, (index, name) in enumerate(sorted(chosen.items())):
        joints = None if truth is None else truth.positions[index]
        for row, (view, axes) in enumerate(_VIEWS.items()):
            _draw(grid[row, column], axes, frames[index], registrar, joints)
            grid[row, column].set_title(f"frame {index} ({name}), {view}", fontsize=9)
    handles, labels = grid[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(labels), fontsize=8)
    return figure


def _bones(body: Body, placement: Placement) -> Iterator[tuple[Array, Array]]:
    """Lines from each segment's origin to its parent's, and to the markers that it carries."""
    origins = placement.transforms[:, :3, 3]
    for segment, parent in enumerate(body.skeleton.parents):
        if parent >= 0:
            yield origins[parent], origins[segment]
    for segment, marker in zip(
        body.markers.segments, body.markers.place(placement.transforms), strict=True
    ):
        yield origins[segment], marker


def _outlines(
    primitives: Primitives, placement: Placement, view: tuple[int, int]
) -> Iterator[Array]:
    """What a view shows of primitives, each a closed line (2, P) [m]."""
    placed = primitives.place(placement.transforms)
    if isinstance(primitives, Gaussians):
        for centre, covariance in zip(placed.centres, placed.covariances(), strict=True):
            # The outline of a projected ellipsoid is the ellipse of its projected covariance.
            root = np.linalg.cholesky(covariance[np.ix_(view, view)])
            yield centre[[*view]][:, None] + root @ _CIRCLE
    elif isinstance(primitives, TaperedCapsules):
        ways = primitives.halves[:, None] * placed.axes[:, :, 1]
        ends = np.stack([placed.centres - ways, placed.centres + ways], axis=1)[:, :, [*view]]
        for pair, radii in zip(ends, primitives.radii, strict=True):
            circles = pair[:, :, None] + 0.5 * radii[:, None, None] * _CIRCLE
            points = circles.transpose(0, 2, 1).reshape(-1, 2)
            around = ConvexHull(points).vertices
            yield points[[*around, around[0]]].T
    elif isinstance(primitives, Volumes):
        surfaces = primitives.surface_points() @ np.swapaxes(placed.axes, 1, 2)
        for points in (placed.centres[:, None] + surfaces)[:, :, [*view]]:
            around = ConvexHull(points).vertices
            yield points[[*around, around[0]]].T


def _draw(
    plot: Axes,
    view: tuple[int, int],
    frame: TrackedFrame,
    registrar: Registrar,
    joints: Array | None,
) -> None:
    across, down = view
    points = frame.observation.points
    plot.scatter(points[:, across], points[:, down], s=2, c="0.72", linewidths=0)
    body = registrar.body
    placement = body.place(frame.registered.pose)
    primitives = registrar.primitives
    if isinstance(primitives, Volumes) and len(primitives) <= MANY:
        for outline in _outlines(primitives, placement, view):
            plot.fill(*outline, facecolor="tab:blue", alpha=0.10)
            plot.plot(*outline, color="tab:blue", linewidth=0.8)
    else:
        centres = primitives.place(placement.transforms).centres
        plot.scatter(centres[:, across], centres[:, down], s=1, c="tab:blue", linewidths=0)
    for start, end in _bones(body, placement):
        plot.plot(
            [start[across], end[across]], [start[down], end[down]], color="tab:orange", lw=1.5
        )
    markers = body.markers.place(placement.transforms)
    plot.plot(
        markers[:, across], markers[:, down], ".", color="tab:red", markersize=5, label="found"
    )
    if joints is not None:
        plot.plot(joints[:, across], joints[:, down], "k+", markersize=6, label="reference")
    plot.set_aspect("equal")
    plot.invert_yaxis()
    plot.tick_params(labelsize=7)
    plot.locator_params(axis="x", nbins=4)
    plot.set_xlabel("x [m]" if across == 0 else "z [m]", fontsize=8)
    plot.set_ylabel("y [m]", fontsize=8)
