"""What is around a cloud: the nearest point of each cell, and the free space of its view."""

from __future__ import annotations

from math import floor
from typing import NamedTuple

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled
from regkit_plugins.alignment_starts.features.compiled_orientation import across

MARGIN = 2
"""Number of cells around a point of which it may be the nearest one."""

BORDER = 3
"""Number of empty pixels around a view."""


class Surroundings(NamedTuple):
    """A cloud with its surroundings.

    Attributes:
        points: The points, (N, 3) [m].
        normals: Their normals with the sign of the outer side, (N, 3).
        low: Corner of the grid, (3,) [m].
        size: Side of a cell [m].
        nearest: Index of the point nearest to the centre of each cell, (X, Y, Z); -1 for none near.
        seen: Whether the cloud is a single view.
        axes: Axes of the view, the last one to the camera, (3, 3).
        corner: Corner of the view, (2,) [m].
        pixel: Side of a pixel [m].
        front: Height of the surface in each pixel [m], beyond which space is free; -inf where the
            view is empty, (U, V).
    """

    points: Array
    normals: Array
    low: Array
    size: float
    nearest: Indices
    seen: bool
    axes: Array
    corner: Array
    pixel: float
    front: Array


@compiled
def surroundings(
    points: Array, normals: Array, size: float, view: Array, seen: bool, pixel: float
) -> Surroundings:
    """Returns a cloud with its surroundings.

    Args:
        points: The points, (N, 3) [m].
        normals: Their normals, (N, 3).
        size: Side of a cell [m].
        view: Unit direction to the camera, (3,).
        seen: Whether the cloud is a single view.
        pixel: Side of a pixel [m].
    """
    low, counts = np.empty(3), np.empty(3, np.int64)
    for d in range(3):
        least, most = points[:, d].min(), points[:, d].max()
        low[d] = least - (MARGIN + 0.5) * size
        counts[d] = int((most - low[d]) / size) + MARGIN + 1
    nearest = np.full((counts[0], counts[1], counts[2]), -1)
    best = np.full((counts[0], counts[1], counts[2]), np.inf)
    cell = np.empty(3, np.int64)
    for n in range(len(points)):
        for d in range(3):
            cell[d] = int((points[n, d] - low[d]) / size)
        for x in range(max(cell[0] - MARGIN, 0), min(cell[0] + MARGIN + 1, counts[0])):
            for y in range(max(cell[1] - MARGIN, 0), min(cell[1] + MARGIN + 1, counts[1])):
                for z in range(max(cell[2] - MARGIN, 0), min(cell[2] + MARGIN + 1, counts[2])):
                    u = low[0] + (x + 0.5) * size - points[n, 0]
                    v = low[1] + (y + 0.5) * size - points[n, 1]
                    w = low[2] + (z + 0.5) * size - points[n, 2]
                    square = u * u + v * v + w * w
                    if square < best[x, y, z]:
                        best[x, y, z], nearest[x, y, z] = square, n
    axes = np.empty((3, 3))
    axes[0], axes[1] = across(view)
    axes[2] = view
    corner, front = _front(points, axes, pixel)
    return Surroundings(points, normals, low, size, nearest, seen, axes, corner, pixel, front)


@compiled
def _front(points: Array, axes: Array, pixel: float) -> tuple[Array, Array]:
    """Returns the corner (2,) [m] of a view, and the height of its surface (U, V) [m].

    A pixel beside a measured one has the greatest height of its neighbours, because the surface may
    go on there.
    """
    places = np.empty((len(points), 3))
    for n in range(len(points)):
        for i in range(3):
            places[n, i] = 0.0
            for j in range(3):
                places[n, i] += axes[i, j] * points[n, j]
    corner = np.array([places[:, 0].min() - BORDER * pixel, places[:, 1].min() - BORDER * pixel])
    width = int((places[:, 0].max() - corner[0]) / pixel) + BORDER + 1
    height = int((places[:, 1].max() - corner[1]) / pixel) + BORDER + 1
    front = np.full((width, height), -np.inf)
    for n in range(len(points)):
        x = floor((places[n, 0] - corner[0]) / pixel)
        y = floor((places[n, 1] - corner[1]) / pixel)
        front[x, y] = max(front[x, y], places[n, 2])
    wider = front.copy()
    for x in range(1, width - 1):
        for y in range(1, height - 1):
            if front[x, y] == -np.inf:
                for i in range(x - 1, x + 2):
                    for j in range(y - 1, y + 2):
                        wider[x, y] = max(wider[x, y], front[i, j])
    return corner, wider
