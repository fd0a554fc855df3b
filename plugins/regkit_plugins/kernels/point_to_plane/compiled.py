"""Forces of matched data on surfels, in compiled loops."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled


@compiled
def pulled_surfels(
    owners: Indices,
    offsets: Array,
    normals: Array,
    tensions: Array,
    point_share: float,
    turning: bool,
    count: int,
) -> tuple[Array, Array]:
    """Wrenches (K, 6) and Gauss-Newton blocks (K, 6, 6) of M matches.

    Of half the square ``(1 - t) (n.q)^2 + t |q|^2`` of each, times its tension, for the way q from
    the surfel to the point. With g = (-n, n x q), the derivative of n.q, or (-n, 0) if n is not the
    surfel's own, the block is ``(1 - t) g g^T + t (I, 0)^T (I, 0)``.

    Args:
        owners: The surfel of each match, (M,).
        offsets: q, (M, 3) [m].
        normals: n, (M, 3).
        tensions: (M,) [1/m^2].
        point_share: t.
        turning: Whether n turns with the surfel.
        count: K.
    """
    wrenches, blocks = np.zeros((count, 6)), np.zeros((count, 6, 6))
    way = np.zeros(6)
    for match in range(len(owners)):
        tension = tensions[match]
        if tension == 0.0:
            continue
        n, q = normals[match], offsets[match]
        along = n[0] * q[0] + n[1] * q[1] + n[2] * q[2]
        for i in range(3):
            way[i] = -n[i]
        if turning:
            way[3] = n[1] * q[2] - n[2] * q[1]
            way[4] = n[2] * q[0] - n[0] * q[2]
            way[5] = n[0] * q[1] - n[1] * q[0]
        wrench, block = wrenches[owners[match]], blocks[owners[match]]
        for i in range(6):
            pull = (1.0 - point_share) * tension * way[i]
            wrench[i] += along * pull
            for j in range(6):
                block[i, j] += pull * way[j]
        for i in range(3):
            wrench[i] -= point_share * tension * q[i]
            block[i, i] += point_share * tension
    return wrenches, blocks
