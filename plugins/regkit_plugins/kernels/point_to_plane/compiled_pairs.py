"""Residuals of pairs of data and surfels, in a compiled loop."""

from __future__ import annotations

from math import sqrt

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled


@compiled
def pair_residuals(
    data: Array,
    normals: Array,
    centres: Array,
    axes: Array,
    points: Indices,
    surfels: Indices,
    point_share: float,
) -> tuple[Array, Array]:
    """Returns residuals (M, D) and their derivatives to the surfels' motions, (M, D, 6).

    With the offset q from the surfel to the point and the normal n they are sqrt(1 - t) n.q, unless
    t is one, and sqrt(t) q, unless it is zero. The derivative of n.q is (-n, n x q), or (-n, 0) for
    normals of the data.

    Args:
        data: Points of the data, (N, 3) [m].
        normals: Their normals, (N, 3), or (0, 3) for those of the surfels.
        centres: Surfels, (K, 3) [m].
        axes: Their axes, of which the third is the normal, (K, 3, 3).
        points: Point of each pair, (M,).
        surfels: Surfel of each pair, (M,).
        point_share: t.
    """
    plane, point = sqrt(1.0 - point_share), sqrt(point_share)
    first = 1 if plane > 0.0 else 0
    parts = first + (3 if point > 0.0 else 0)
    values, rows = np.empty((len(points), parts)), np.zeros((len(points), parts, 6))
    for pair in range(len(points)):
        i, k = points[pair], surfels[pair]
        x, y, z = data[i, 0] - centres[k, 0], data[i, 1] - centres[k, 1], data[i, 2] - centres[k, 2]
        if plane > 0.0:
            if len(normals):
                a, b, c = normals[i, 0], normals[i, 1], normals[i, 2]
            else:
                a, b, c = axes[k, 0, 2], axes[k, 1, 2], axes[k, 2, 2]
                rows[pair, 0, 3] = plane * (b * z - c * y)
                rows[pair, 0, 4] = plane * (c * x - a * z)
                rows[pair, 0, 5] = plane * (a * y - b * x)
            values[pair, 0] = plane * (a * x + b * y + c * z)
            rows[pair, 0, 0], rows[pair, 0, 1], rows[pair, 0, 2] = (
                -plane * a,
                -plane * b,
                -plane * c,
            )
        if point > 0.0:
            values[pair, first] = point * x
            values[pair, first + 1] = point * y
            values[pair, first + 2] = point * z
            for d in range(3):
                rows[pair, first + d, d] = -point
    return values, rows
