"""Distances of points in the free space of a depth image, in compiled loops."""

from __future__ import annotations

from math import sqrt

import numpy as np

from regkit.observation.compiled_blocks import NEAREST
from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled


@compiled
def free_space_distances(
    points: Array,
    margins: Array,
    nearest: Array,
    shown: Indices,
    scale: Array,
    offset: Array,
    half: float,
) -> tuple[Array, Array]:
    """Returns the distances (M,) [m] and gradients (M, 3) of ``Silhouette.distances``.

    Args:
        points: Points in the camera frame, (M, 3) [m].
        margins: Allowed distance of each point in front of the measured depth, (M,) [m].
        nearest: Minimum depth of each block, (columns, rows) [m]; inf for a block without depth.
        shown: Row of the nearest block with depth at or above each block, and at or below it,
            (columns, rows, 2), -1 where there is none; see ``block_depths``.
        scale: Blocks per unit of normalised image coordinates, (2,).
        offset: Block coordinates of the principal point, (2,).
        half: Radius of a block in normalised image coordinates; a ray closer than this to a block
            with depth is inside the silhouette.
    """
    distances, gradients = np.empty(len(points)), np.empty((len(points), 3))
    columns, rows = nearest.shape
    for k in range(len(points)):
        distances[k] = gradients[k, 0] = gradients[k, 1] = gradients[k, 2] = 0.0
        z = max(points[k, 2], NEAREST)
        x, y = points[k, 0] / z, points[k, 1] / z
        column = int(np.rint(x * scale[0] + offset[0]))
        row = int(np.rint(y * scale[1] + offset[1]))
        if not (0 <= column < columns and 0 <= row < rows):
            # Nothing is known beyond the picture.
            continue
        if np.isfinite(nearest[column, row]):
            before = nearest[column, row] - margins[k] - points[k, 2]
            if before > 0.0:
                distances[k] = before
                gradients[k, 2] = -1.0
            continue
        # In a column the nearest block is the next one up or down, and columns that are farther
        # than the best block so far hold no better one.
        least, best_x, best_y, step = np.inf, 0.0, 0.0, 0
        while step < columns and ((step - 0.5) / scale[0]) ** 2 < least:
            for side in range(2):
                other = column - step if side == 0 else column + step
                if not 0 <= other < columns:
                    continue
                centre_x = (other - offset[0]) / scale[0]
                for way in range(2):
                    if shown[other, row, way] < 0:
                        continue
                    centre_y = (shown[other, row, way] - offset[1]) / scale[1]
                    square = (x - centre_x) ** 2 + (y - centre_y) ** 2
                    if square < least:
                        least, best_x, best_y = square, centre_x, centre_y
            step += 1
        distance = sqrt(least)
        if not half < distance < np.inf:
            continue
        away, down = (x - best_x) / distance, (y - best_y) / distance
        distances[k] = z * (distance - half)
        gradients[k, 0], gradients[k, 1] = away, down
        gradients[k, 2] = distance - half - away * x - down * y
    return distances, gradients
