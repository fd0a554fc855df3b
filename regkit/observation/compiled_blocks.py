"""Blocks of the pixels of a depth image, in compiled loops."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled

NEAREST = 1e-3
"""Points nearer than this are projected as if they were as far [m]."""

UNKNOWN = 1e300
"""Stands for an unknown depth; any measured one is nearer."""


@compiled
def block_depths(depth: Array, side: int) -> tuple[Array, Indices]:
    """Returns the minimum depth of each block, and the nearest blocks with depth in its column.

    Args:
        depth: Depth image, (H, W) [m]; zero where nothing is, NaN where it is unknown.
        side: Side of a block [px].

    Returns:
        The minimum depths (columns, rows) [m], inf for a block without depth, but zero if a pixel
        of it is unknown; and the row of the nearest block with a finite minimum at or above each
        block, and at or below it, (columns, rows, 2), -1 where there is none.
    """
    rows, columns = depth.shape[0] // side, depth.shape[1] // side
    nearest, width = np.empty((columns, rows)), columns * side
    strip = np.empty(width)
    for row in range(rows):
        for at in range(width):
            strip[at] = np.inf
        # Without branches, these loops over whole rows run on several pixels at once.
        for line in range(row * side, (row + 1) * side):
            for at in range(width):
                value = depth[line, at]
                value = value if value > 0.0 else (np.inf if value <= 0.0 else UNKNOWN)
                strip[at] = value if value < strip[at] else strip[at]
        for column in range(columns):
            least = np.inf
            for at in range(column * side, (column + 1) * side):
                least = min(least, strip[at])
            nearest[column, row] = 0.0 if least == UNKNOWN else least
    shown = np.empty((columns, rows, 2), dtype=np.intp)
    for column in range(columns):
        last = -1
        for row in range(rows):
            if nearest[column, row] < np.inf:
                last = row
            shown[column, row, 0] = last
        last = -1
        for row in range(rows - 1, -1, -1):
            if nearest[column, row] < np.inf:
                last = row
            shown[column, row, 1] = last
    return nearest, shown


@compiled
def observable_points(
    points: Array, margins: Array, nearest: Array, scale: Array, offset: Array
) -> NDArray[np.bool_]:
    """Returns the points (M,) of ``Silhouette.observable``.

    Args:
        points: Points in the camera frame, (M, 3) [m].
        margins: Distance behind the measured depth from which on a point is hidden, (M,) [m].
        nearest: Minimum depth of each block, (columns, rows) [m]; see ``block_depths``.
        scale: Blocks per unit of normalised image coordinates, (2,).
        offset: Block coordinates of the principal point, (2,).
    """
    columns, rows = nearest.shape
    shown = np.empty(len(points), dtype=np.bool_)
    for k in range(len(points)):
        z, shown[k] = points[k, 2], False
        if not z > 0.0:
            continue
        far = max(z, NEAREST)
        column = np.rint(points[k, 0] / far * scale[0] + offset[0])
        row = np.rint(points[k, 1] / far * scale[1] + offset[1])
        if 0.0 <= column < columns and 0.0 <= row < rows:
            least = nearest[int(column), int(row)]
            shown[k] = least > 0.0 and z - margins[k] <= least
    return shown
