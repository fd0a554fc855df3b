"""Back-projection of depth images in a compiled loop."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array
from regkit.system.compiled import compiled


@compiled
def back_project(depth: Array, fx: float, fy: float, cx: float, cy: float) -> tuple[Array, float]:
    """Returns the points (N, 3) [m] of all pixels with depth > 0, and the largest depth [m].

    Args:
        depth: Depth image, (H, W) [m].
        fx: Horizontal focal length [px].
        fy: Vertical focal length [px].
        cx: Column of the principal point [px].
        cy: Row of the principal point [px].
    """
    height, width = depth.shape
    count = 0
    for row in range(height):
        for column in range(width):
            if depth[row, column] > 0.0:
                count += 1
    points = np.empty((count, 3))
    farthest, at = 0.0, 0
    for row in range(height):
        for column in range(width):
            z = depth[row, column]
            if z > 0.0:
                points[at, 0] = (column - cx) * z / fx
                points[at, 1] = (row - cy) * z / fy
                points[at, 2] = z
                farthest = max(farthest, z)
                at += 1
    return points, farthest
