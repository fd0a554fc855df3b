"""Normals with the sign of the outer side, and the direction from which a cloud was seen."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from regkit.system.arrays import Array
from regkit_plugins.alignment_starts.features.compiled_orientation import (
    convexities,
    hidden_shares,
    rim_height,
)

DIRECTIONS = 150
"""Number of directions that are tried, on a half sphere."""

PIXEL = 1.2
"""Side of a pixel, in distances of neighbouring points."""

HIDDEN = 0.06
"""A cloud of which a greater fraction would be hidden from every side is not one view."""

NEAR_BEST = 0.01
"""Directions within this fraction of hidden points of the best one are averaged."""

CURVATURE = 0.08
"""Radius within which a view's surface has to be convex on average, relative to its size."""

OUTER = 0.15
"""Radius of the neighbourhood that tells the outer side of a whole body, relative to its size."""


def oriented(points: Array, normals: Array, spacing: float) -> tuple[Array, Array | None]:
    """Returns normals (N, 3) of one sign, and the direction to the camera (3,) of a single view.

    A view is recognised as such: from its camera's side, no point hides another. Its normals point
    to the camera; those of other clouds point away from the points around them.

    Args:
        points: The points, (N, 3) [m].
        normals: Their normals of any sign, (N, 3).
        spacing: Distance of neighbouring points [m].
    """
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    view = _view(points, normals, PIXEL * spacing, CURVATURE * size)
    side = convexities(points, normals, OUTER * size) if view is None else normals @ view
    return normals * np.where(side < 0.0, -1.0, 1.0)[:, None], view


def _view(points: Array, normals: Array, pixel: float, radius: float) -> Array | None:
    """Returns the direction to the camera (3,) of a single view; None for other clouds."""
    directions = _half_sphere()
    hidden = hidden_shares(points, normals, directions, pixel)
    least = float(hidden.min())
    if least > HIDDEN:
        return None
    # The mean axis of all directions from which nearly nothing is hidden.
    near = directions[hidden <= least + NEAR_BEST]
    view = np.linalg.eigh(near.T @ near)[1][:, -1]
    if hidden_shares(points, normals, view[None], pixel)[0] > least + 2.0 * NEAR_BEST:
        view = directions[int(hidden.argmin())]
    # A body is convex on the whole, and its surface recedes towards the silhouette.
    outer = normals * np.where(normals @ view < 0.0, -1.0, 1.0)[:, None]
    bulges = convexities(points, outer, radius)
    convex = float(bulges.sum() / max(float(np.abs(bulges).sum()), 1e-300))
    return np.asarray(view if convex >= rim_height(points, view, pixel) else -view)


@lru_cache(maxsize=1)
def _half_sphere() -> Array:
    """Returns evenly spread directions on a half sphere, (D, 3), by the golden angle."""
    number = np.arange(DIRECTIONS) + 0.5
    height, turn = 1.0 - number / DIRECTIONS, np.pi * (1.0 + np.sqrt(5.0)) * number
    radius = np.sqrt(1.0 - height**2)
    return np.column_stack([radius * np.cos(turn), radius * np.sin(turn), height])
