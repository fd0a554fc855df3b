"""The correlation of residuals over distance, in a compiled loop."""

from __future__ import annotations

from math import sqrt

import numpy as np

from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Vector


@compiled
def products_by_distance(points: Matrix, residuals: Matrix, width: float, count: int) -> Vector:
    """Returns the sums (B,) of the products of all pairs' residuals, by distance.

    Args:
        points: The points, (M, 3) [m].
        residuals: Their residuals, (M, D).
        width: Width of a bin of distances [m].
        count: Number B of bins; pairs beyond are left out.
    """
    sums, parts = np.zeros(count), residuals.shape[1]
    farthest = (width * count) ** 2
    for i in range(len(points)):
        x, y, z = points[i, 0], points[i, 1], points[i, 2]
        for j in range(i):
            dx, dy, dz = points[j, 0] - x, points[j, 1] - y, points[j, 2] - z
            square = dx * dx + dy * dy + dz * dz
            if square >= farthest:
                continue
            product = 0.0
            for part in range(parts):
                product += residuals[i, part] * residuals[j, part]
            sums[min(int(sqrt(square) / width), count - 1)] += product
    return sums
