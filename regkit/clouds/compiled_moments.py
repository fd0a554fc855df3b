"""Sums of coordinates and of their products, in a compiled loop."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array
from regkit.system.compiled import compiled


@compiled(reordered=True)
def moments(points: Array, origin: Array) -> Array:
    """Returns the sum of (1, x, y, z)^T (1, x, y, z) over points relative to an origin, (4, 4).

    Args:
        points: The points, (N, 3) [m].
        origin: The origin, (3,) [m].
    """
    a, b, c = origin[0], origin[1], origin[2]
    sx = sy = sz = xx = xy = xz = yy = yz = zz = 0.0
    for n in range(len(points)):
        x, y, z = points[n, 0] - a, points[n, 1] - b, points[n, 2] - c
        sx += x
        sy += y
        sz += z
        xx += x * x
        xy += x * y
        xz += x * z
        yy += y * y
        yz += y * z
        zz += z * z
    count = float(len(points))
    return np.array([[count, sx, sy, sz], [sx, xx, xy, xz], [sy, xy, yy, yz], [sz, xz, yz, zz]])
