"""Residuals of blended points on the segments that carry them, in a compiled loop."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled


@compiled
def residuals_on_segments(
    owners: Indices,
    values: Array,
    rows: Array,
    weights: Array,
    segments: Indices,
    blend: Array,
    arms: Array,
    turned: Array,
    axes: Array,
    lengths: Array,
    count: int,
) -> tuple[Array, Array]:
    """Returns wrenches (S, 6) and blocks (S, 6, 6) on the segments about their origins.

    They are those of ``accumulated_wrenches`` and ``accumulated_stiffness`` in ``skinning``, from
    the residuals themselves: the derivatives of most points are zero, and those of the others are
    carried to the segments before they are squared.

    Args:
        owners: Point of each residual, (R,).
        values: Residuals r with D components, (R, D).
        rows: Derivatives to the motions of points and normals, (R, D, 6).
        weights: Weights of the residuals, (R,).
        segments: Carriers of each point, (K, A).
        blend: Blend weights, (K, A).
        arms: Arms from ``place_blended``, (K, A, 3) [m].
        turned: Carried normals from ``place_blended``, (K, A, 3).
        axes: Axes from ``place_blended``, (K, 3, 3).
        lengths: Norms from ``place_blended``, (K,).
        count: Number S of segments.
    """
    wrenches, blocks = np.zeros((count, 6)), np.zeros((count, 6, 6))
    row = np.empty(6)
    for i in range(len(owners)):
        if weights[i] == 0.0:
            continue
        k = owners[i]
        nx, ny, nz = axes[k, 0, 2], axes[k, 1, 2], axes[k, 2, 2]
        for a in range(segments.shape[1]):
            weight = blend[k, a]
            if weight == 0.0:
                continue
            x, y, z = arms[k, a, 0], arms[k, a, 1], arms[k, a, 2]
            mx, my, mz = turned[k, a, 0], turned[k, a, 1], turned[k, a, 2]
            along, turning = nx * mx + ny * my + nz * mz, weight / lengths[k]
            wrench, block = wrenches[segments[k, a]], blocks[segments[k, a]]
            for d in range(values.shape[1]):
                f, g, h = rows[i, d, 0], rows[i, d, 1], rows[i, d, 2]
                p, q, r = rows[i, d, 3], rows[i, d, 4], rows[i, d, 5]
                across = p * mx + q * my + r * mz
                row[0], row[1], row[2] = weight * f, weight * g, weight * h
                # The point turns about the segment's origin; [n]x [m]x is m n^T - (n.m) I.
                row[3] = weight * (y * h - z * g) + turning * (along * p - across * nx)
                row[4] = weight * (z * f - x * h) + turning * (along * q - across * ny)
                row[5] = weight * (x * g - y * f) + turning * (along * r - across * nz)
                for e in range(6):
                    scaled = weights[i] * row[e]
                    wrench[e] += scaled * values[i, d]
                    for b in range(e + 1):
                        block[e, b] += scaled * row[b]
    for s in range(count):
        for e in range(6):
            for b in range(e):
                blocks[s, b, e] = blocks[s, e, b]
    return wrenches, blocks
