"""Unknown regions at which the data end: there a body may go on, as beyond a picture's border."""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import NDArray

from regkit.geometry.camera import Camera
from regkit.system.arrays import Array

WIDE = 0.2
"""Least width of an unknown region in which a part of the body may be, as a fraction of the data's
longer side. A camera's shadow is narrower: beyond it the body would be seen."""

REACH = 3
"""Data touch a region within this distance [px]."""

TOUCHING = 0.2
"""Least length over which they touch it, as a fraction of their longer side."""

SAME = np.cos(np.radians(30.0))
"""Lines of a smaller angle are one: that of an oblique edge is found on two sides."""

SIDES = ((0, 1), (0, -1), (1, 1), (1, -1))
"""Axis and sign of the directions in which a region may be: right, left, below, above."""


def unknown_cuts(camera: Camera, depth: Array, points: Array) -> list[tuple[int, Array]]:
    """Returns where unknown regions cut the data off: a straight line for each side.

    Args:
        camera: The camera.
        depth: Its depth image, (H, W) [m]; NaN where it is unknown.
        points: The data, (N, 3) [m].

    Returns:
        For each line the length of the contact [px], and the outward unit normal (3,) of the plane
        through the camera and the line; the longest first.
    """
    if not np.isnan(depth).any():
        return []
    extent = float(np.ptp(camera.projected(points), axis=0).max())
    wide, shown = wide_part(np.isnan(depth), max(1, round(WIDE * extent))), depth > 0.0
    contacts = [(_contact(shown, wide, axis, sign), axis, sign) for axis, sign in SIDES]
    contacts.sort(key=lambda one: -len(one[0][0]))
    found: list[tuple[int, Array]] = []
    for (along, across), axis, sign in contacts:
        if len(along) < max(3.0, TOUCHING * extent):
            break
        normal = _normal(camera, np.polyfit(along, across + 0.5 * sign, 1), axis, sign)
        if all(normal @ other < SAME for _, other in found):
            found.append((len(along), normal))
    return found


def _normal(camera: Camera, line: Array, axis: int, sign: int) -> Array:
    """Returns the outward unit normal (3,) of the plane through the camera and a line.

    Args:
        camera: The camera.
        line: Slope and level of the line along the other axis, (2,) [px].
        axis: Axis across the line: 0 for columns, 1 for rows.
        sign: Direction of the outside along this axis.
    """
    weights = np.full(2, -line[0])
    weights[axis] = 1.0
    level = weights[0] * camera.cx + weights[1] * camera.cy - line[1]
    normal = sign * np.array([weights[0] * camera.fx, weights[1] * camera.fy, level])
    return np.asarray(normal / np.linalg.norm(normal))


def wide_part(unknown: NDArray[np.bool_], width: int) -> NDArray[np.bool_]:
    """Returns the part of an unknown region (H, W) that squares cover; all is unknown beyond it.

    Args:
        unknown: The region, (H, W).
        width: Side of the squares [px].
    """
    padded = np.pad(unknown, width, constant_values=True).astype(np.uint8)
    # Of an even width, the second filter is the mirror image of the first.
    origin = -1 if width % 2 == 0 else 0
    opened = scipy.ndimage.maximum_filter(
        scipy.ndimage.minimum_filter(padded, width), width, origin=origin
    )
    return np.asarray(opened[width:-width, width:-width] > 0)


def _contact(
    shown: NDArray[np.bool_], wide: NDArray[np.bool_], axis: int, sign: int
) -> tuple[Array, Array]:
    """Returns where data touch a region on one side: their places along it, and across it.

    Args:
        shown: Pixels with data, (H, W).
        wide: Pixels of the region, (H, W).
        axis: Axis of the direction: 0 for columns, 1 for rows.
        sign: Sign of the direction.
    """
    # The direction runs along the rows of these.
    shown, wide = (one if axis == 0 else one.T for one in (shown, wide))
    if sign < 0:
        shown, wide = shown[:, ::-1], wide[:, ::-1]
    beyond = np.zeros_like(shown)
    for step in range(1, REACH + 1):
        beyond[:, :-step] |= wide[:, step:]
    # Only the last pixel before the region is the end of the data.
    along, across = np.nonzero(shown & beyond & ~np.pad(shown[:, 1:], ((0, 0), (0, 1))))
    if sign < 0:
        across = shown.shape[1] - 1 - across
    return along.astype(np.float64), across.astype(np.float64)
