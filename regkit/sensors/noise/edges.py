"""Depth steps and displacements between neighbouring pixels."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from regkit.sensors.raycast import View
from regkit.system.arrays import Array, Indices

_SIDES = ((0, 1), (0, -1), (1, 0), (-1, 0))


def step_across(depth: Array) -> Array:
    """Returns the largest step (H, W) [m] from each pixel to its four neighbours.

    The step is infinite next to an invalid pixel, and zero at an invalid pixel. Pixels outside of
    the image are not neighbours.
    """
    whole, shown = np.zeros(depth.shape), _shown(depth)
    depth = depth[shown]
    inside = np.where(depth > 0.0, depth, np.inf)
    padded = np.pad(inside, 1, mode="edge")
    rows, columns = depth.shape
    largest = np.zeros(depth.shape)
    with np.errstate(invalid="ignore"):  # Of the infinite ones, which are taken out below.
        for down, right in _SIDES:
            other = padded[1 + down : 1 + down + rows, 1 + right : 1 + right + columns]
            step = other - inside
            largest = np.where(np.abs(step) > np.abs(largest), step, largest)
    whole[shown] = np.where(depth > 0.0, largest, 0.0)
    return whole


def _shown(depth: Array) -> tuple[slice, slice]:
    """Returns the rows and columns that hold all valid pixels (H, W) and their neighbours."""
    seen = depth > 0.0
    return _around(seen, 1), _around(seen, 0)


def _around(seen: NDArray[np.bool_], axis: int) -> slice:
    """Returns the part of an image's side that holds all true pixels, and one beside them."""
    places = np.flatnonzero(seen.any(axis=axis))
    return slice(max(places[0] - 1, 0), places[-1] + 2) if len(places) else slice(0, 1)


def displaced(view: View, shifts: Indices) -> View:
    """Returns the view with each pixel replaced by one at an offset.

    Args:
        view: The view.
        shifts: Offsets in rows and columns, (2, H, W), clipped to the image.
    """
    height, width = view.depth.shape
    rows, columns = np.indices((height, width)) + shifts
    at = np.clip(rows, 0, height - 1), np.clip(columns, 0, width - 1)
    return View(view.depth[at], view.cosines[at])
