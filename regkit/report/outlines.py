"""The outlines of primitives in a view."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.spatial import ConvexHull

from regkit.report.look import Form
from regkit.system.arrays import Array

_CIRCLE = np.array([np.cos(np.linspace(0, 2 * np.pi, 49)), np.sin(np.linspace(0, 2 * np.pi, 49))])


def outlines(form: Form, view: tuple[int, int]) -> Iterator[Array]:
    """What a view shows of primitives, each a closed line (2, P) [m]; nothing of points.

    Args:
        form: Gaussians, of which the 2-sigma ellipsoids are seen, capsules, or other solids.
        view: The axes of the camera's frame to the right and down.
    """
    if form.kind == "gaussians":
        for centre, covariance in zip(form.centres, form.covariances(), strict=True):
            # The outline of a projected ellipsoid is the ellipse of its projected covariance.
            root = np.linalg.cholesky(covariance[np.ix_(view, view)])
            yield centre[[*view]][:, None] + 2.0 * root @ _CIRCLE
    elif form.kind == "capsules":
        ways = form.halves[:, None] * form.axes[:, :, 1]
        ends = np.stack([form.centres - ways, form.centres + ways], axis=1)[:, :, [*view]]
        for pair, radii in zip(ends, form.radii, strict=True):
            circles = pair[:, :, None] + radii[:, None, None] * _CIRCLE
            yield _hull(circles.transpose(0, 2, 1).reshape(-1, 2))
    elif form.kind == "solids":
        surfaces = form.centres[:, None] + form.surfaces @ np.swapaxes(form.axes, 1, 2)
        yield from map(_hull, surfaces[:, :, [*view]])


def _hull(points: Array) -> Array:
    """The closed line (2, P) around points (N, 2)."""
    around = ConvexHull(points).vertices
    return np.asarray(points[[*around, around[0]]].T)
