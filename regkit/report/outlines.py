"""Outlines of primitives in an orthographic view."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import scipy

from regkit.report.frame_drawing import DrawnPrimitives
from regkit.system.arrays import Array

_CIRCLE = np.array([np.cos(np.linspace(0, 2 * np.pi, 49)), np.sin(np.linspace(0, 2 * np.pi, 49))])


def outlines(primitives: DrawnPrimitives, view: tuple[int, int]) -> Iterator[Array]:
    """Yields the outline of each primitive as a closed line (2, P) [m]; points have none.

    Args:
        primitives: Gaussians (drawn as 2-sigma ellipsoids), capsules or other solids.
        view: The horizontal and the vertical axis of the view, in the camera frame.
    """
    if primitives.kind == "gaussians":
        for centre, covariance in zip(primitives.centres, primitives.covariances(), strict=True):
            # The outline of a projected ellipsoid is the ellipse of its projected covariance.
            root = np.linalg.cholesky(covariance[np.ix_(view, view)])
            yield centre[[*view]][:, None] + 2.0 * root @ _CIRCLE
    elif primitives.kind == "capsules":
        half_axes = primitives.halves[:, None] * primitives.axes[:, :, 1]
        ends = np.stack([primitives.centres - half_axes, primitives.centres + half_axes], axis=1)[
            :, :, [*view]
        ]
        for pair, radii in zip(ends, primitives.radii, strict=True):
            circles = pair[:, :, None] + radii[:, None, None] * _CIRCLE
            yield _hull(circles.transpose(0, 2, 1).reshape(-1, 2))
    elif primitives.kind == "solids":
        surfaces = primitives.centres[:, None] + primitives.surfaces @ np.swapaxes(
            primitives.axes, 1, 2
        )
        yield from map(_hull, surfaces[:, :, [*view]])


def _hull(points: Array) -> Array:
    """Returns the convex hull of points (N, 2) as a closed line (2, P)."""
    around = scipy.spatial.ConvexHull(points).vertices
    return np.asarray(points[[*around, around[0]]].T)
