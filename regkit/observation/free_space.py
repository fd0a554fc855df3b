"""Distances of points in the free space of a depth image, in compiled loops."""

from __future__ import annotations

from math import sqrt

import numpy as np

from regkit.system.arrays import Array
from regkit.system.compiled import compiled


@compiled
def free_space_distances(
    points: Array,
    margins: Array,
    nearest: Array,
    shown: Array,
    scale: Array,
    offset: Array,
    half: float,
) -> tuple[Array, Array]:
    """Returns the distances (M,) [m] and gradients (M, 3) of ``Silhouette.distances``.

    Args:
        points: Points in the camera frame, (M, 3) [m].
        margins: Allowed distance of each point in front of the measured depth, (M,) [m].
        nearest: Minimum depth of each block, (columns, rows) [m]; inf for a block without depth.
        shown: Normalised image coordinates of the centres of the B blocks with depth, (B, 2).
        scale: Blocks per unit of normalised image coordinates, (2,).
        offset: Block coordinates of the principal point, (2,).
        half: Radius of a block in normalised image coordinates; a ray closer than this to a block
            with depth is inside the silhouette.
    """
    distances, gradients = np.zeros(len(points)), np.zeros((len(points), 3))
    columns, rows = nearest.shape
    for k in range(len(points)):
        z = max(points[k, 2], 1e-3)
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
        best, least = -1, np.inf
        for index in range(len(shown)):
            square = (x - shown[index, 0]) ** 2 + (y - shown[index, 1]) ** 2
            if square < least:
                best, least = index, square
        distance = sqrt(least)
        if best < 0 or distance <= half:
            continue
        away, down = (x - shown[best, 0]) / distance, (y - shown[best, 1]) / distance
        distances[k] = z * (distance - half)
        gradients[k, 0], gradients[k, 1] = away, down
        gradients[k, 2] = distance - half - away * x - down * y
    return distances, gradients
