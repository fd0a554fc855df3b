"""Accumulation of residuals on primitives, and of wrenches on segments, in compiled loops."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled


@compiled
def accumulated_wrenches(wrenches: Array, arms: Array, owners: Indices, segments: int) -> Array:
    """Returns wrenches (S, 6) summed on the segments.

    Args:
        wrenches: Wrenches about the primitives' centres, (K, 6).
        arms: Vectors from the segments' reference points to the centres, (K, 3) [m].
        owners: Segment of each primitive, (K,).
        segments: Number S of segments.
    """
    accumulated = np.zeros((segments, 6))
    for k in range(len(wrenches)):
        f, g, h = wrenches[k, 0], wrenches[k, 1], wrenches[k, 2]
        x, y, z = arms[k]
        own = accumulated[owners[k]]
        own[0] += f
        own[1] += g
        own[2] += h
        own[3] += wrenches[k, 3] + y * h - z * g
        own[4] += wrenches[k, 4] + z * f - x * h
        own[5] += wrenches[k, 5] + x * g - y * f
    return accumulated


@compiled
def accumulated_stiffness(blocks: Array, arms: Array, owners: Indices, segments: int) -> Array:
    """Returns blocks (S, 6, 6) summed on the segments, about the same reference points.

    A centre follows its segment's translation and its rotation times the arm: M^T B M with
    M = [[I, -[arm]x], [0, I]].

    Args:
        blocks: Blocks about the primitives' centres, (K, 6, 6).
        arms: Vectors from the segments' reference points to the centres, (K, 3) [m].
        owners: Segment of each primitive, (K,).
        segments: Number S of segments.
    """
    accumulated = np.zeros((segments, 6, 6))
    half = np.empty((6, 6))
    for k in range(len(blocks)):
        x, y, z = arms[k]
        block, own = blocks[k], accumulated[owners[k]]
        for i in range(6):
            a, b, c = block[i, 0], block[i, 1], block[i, 2]
            half[i, 0], half[i, 1], half[i, 2] = a, b, c
            half[i, 3] = block[i, 3] - z * b + y * c
            half[i, 4] = block[i, 4] + z * a - x * c
            half[i, 5] = block[i, 5] - y * a + x * b
        for j in range(6):
            a, b, c = half[0, j], half[1, j], half[2, j]
            own[0, j] += a
            own[1, j] += b
            own[2, j] += c
            own[3, j] += half[3, j] - z * b + y * c
            own[4, j] += half[4, j] + z * a - x * c
            own[5, j] += half[5, j] - y * a + x * b
    return accumulated


@compiled
def accumulated_residuals(
    owners: Indices, values: Array, rows: Array, weights: Array, count: int
) -> tuple[Array, Array]:
    """Returns w J^T r (K, 6) and w J^T J (K, 6, 6), summed over the residuals of each primitive.

    Args:
        owners: Primitive of each residual, (R,).
        values: Residuals r with D components, (R, D).
        rows: Derivatives J to the owners' motions about their centres, (R, D, 6).
        weights: w, (R,).
        count: Number K of primitives.
    """
    wrenches, blocks = np.zeros((count, 6)), np.zeros((count, 6, 6))
    for i in range(len(owners)):
        if weights[i] == 0.0:
            continue
        wrench, block = wrenches[owners[i]], blocks[owners[i]]
        for d in range(values.shape[1]):
            for a in range(6):
                scaled = weights[i] * rows[i, d, a]
                wrench[a] += scaled * values[i, d]
                for b in range(a + 1):
                    block[a, b] += scaled * rows[i, d, b]
    for k in range(count):
        for a in range(6):
            for b in range(a):
                blocks[k, b, a] = blocks[k, a, b]
    return wrenches, blocks
