"""Linear blend skinning of points and normals, and forces on them, in compiled loops.

Segment a carries a point to c_a and its normal to m_a in the world; o_a is the segment's origin and
w_a its blend weight. Blending places the point at v = sum w_a c_a and its normal at
n = sum w_a m_a / l, where l is the length of that sum. Segment motions (dt_a, dphi_a) cause

    dv = sum w_a (dt_a - [c_a - o_a]x dphi_a),    dphi = -1/l sum w_a [n]x [m_a]x dphi_a,

where dphi contains no rotation about the normal, which a point does not have.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled


@compiled
def place_blended(
    transforms: Array,
    segments: Indices,
    blend: Array,
    points: Array,
    normals: Array,
    owners: Indices,
    tangents: Array,
) -> tuple[Array, Array, Array, Array, Array]:
    """Returns v (K, 3), axes (K, 3, 3), arms c_a - o_a and m_a (K, A, 3), and l (K,).

    The third axis is n. The first is the tangent, rotated with the owner and orthogonal to n.

    Args:
        transforms: T_world_segment, (S, 4, 4).
        segments: Carriers of each point, (K, A).
        blend: Blend weights w_a, (K, A).
        points: Points in the carriers' frames, (K, A, 3) [m].
        normals: Unit normals in the carriers' frames, (K, A, 3).
        owners: Segment with the largest weight, (K,).
        tangents: Unit tangents in the owners' frames, (K, 3).
    """
    count, carriers = segments.shape
    centres, axes = np.zeros((count, 3)), np.empty((count, 3, 3))
    mean = np.empty(3)
    arms, turned = np.zeros((count, carriers, 3)), np.zeros((count, carriers, 3))
    lengths = np.empty(count)
    for k in range(count):
        for i in range(3):
            mean[i] = 0.0
        for a in range(carriers):
            weight = blend[k, a]
            if weight == 0.0:
                continue
            carrier = transforms[segments[k, a]]
            c, m = points[k, a], normals[k, a]
            for i in range(3):
                arm = carrier[i, 0] * c[0] + carrier[i, 1] * c[1] + carrier[i, 2] * c[2]
                own = carrier[i, 0] * m[0] + carrier[i, 1] * m[1] + carrier[i, 2] * m[2]
                arms[k, a, i] = arm
                turned[k, a, i] = own
                centres[k, i] += weight * (arm + carrier[i, 3])
                mean[i] += weight * own
        lengths[k] = sqrt(mean[0] ** 2 + mean[1] ** 2 + mean[2] ** 2)
        for i in range(3):
            mean[i] /= lengths[k]
        _set_axes(axes[k], mean, transforms[owners[k]], tangents[k])
    return centres, axes, arms, turned, lengths


@compiled
def accumulated_wrenches(
    wrenches: Array,
    segments: Indices,
    blend: Array,
    arms: Array,
    turned: Array,
    axes: Array,
    lengths: Array,
    count: int,
) -> Array:
    """Returns wrenches (S, 6) on the segments about their origins.

    Args:
        wrenches: Wrenches on points and normals, (K, 6).
        segments: Carriers of each point, (K, A).
        blend: Blend weights, (K, A).
        arms: Arms from ``place_blended``, (K, A, 3) [m].
        turned: Carried normals from ``place_blended``, (K, A, 3).
        axes: Axes from ``place_blended``, (K, 3, 3).
        lengths: Norms from ``place_blended``, (K,).
        count: Number S of segments.
    """
    accumulated = np.zeros((count, 6))
    for k in range(len(wrenches)):
        f, n = wrenches[k], axes[k, :, 2]
        # The transpose of [n]x [m]x is [m]x [n]x.
        x, y, z = _crossed(n[0], n[1], n[2], f[3], f[4], f[5])
        for a in range(segments.shape[1]):
            weight = blend[k, a]
            if weight == 0.0:
                continue
            arm, m, own = arms[k, a], turned[k, a], accumulated[segments[k, a]]
            u, v, w = _crossed(arm[0], arm[1], arm[2], f[0], f[1], f[2])
            p, q, r = _crossed(m[0], m[1], m[2], x, y, z)
            own[0] += weight * f[0]
            own[1] += weight * f[1]
            own[2] += weight * f[2]
            own[3] += weight * (u - p / lengths[k])
            own[4] += weight * (v - q / lengths[k])
            own[5] += weight * (w - r / lengths[k])
    return accumulated


@compiled
def accumulated_stiffness(
    blocks: Array,
    segments: Indices,
    blend: Array,
    arms: Array,
    turned: Array,
    axes: Array,
    lengths: Array,
    count: int,
) -> Array:
    """Returns blocks (S, 6, 6) of the segments about their origins.

    Each carrier receives M^T B M with its own map M; blocks between carriers are neglected.

    Args:
        blocks: Blocks B of points and normals, (K, 6, 6).
        segments: Carriers of each point, (K, A).
        blend: Blend weights, (K, A).
        arms: Arms from ``place_blended``, (K, A, 3) [m].
        turned: Carried normals from ``place_blended``, (K, A, 3).
        axes: Axes from ``place_blended``, (K, 3, 3).
        lengths: Norms from ``place_blended``, (K,).
        count: Number S of segments.
    """
    accumulated = np.zeros((count, 6, 6))
    carried, half = np.zeros((6, 6)), np.empty((6, 6))
    for k in range(len(blocks)):
        block = blocks[k]
        if block[0, 0] + block[1, 1] + block[2, 2] == 0.0:
            continue
        for a in range(segments.shape[1]):
            if blend[k, a] == 0.0:
                continue
            _set_map(carried, blend[k, a], arms[k, a], turned[k, a], axes[k, :, 2], lengths[k])
            own = accumulated[segments[k, a]]
            for i in range(6):
                for j in range(6):
                    half[i, j] = 0.0
                    for e in range(6):
                        half[i, j] += block[i, e] * carried[e, j]
            for i in range(6):
                for j in range(6):
                    for e in range(6):
                        own[i, j] += carried[e, i] * half[e, j]
    return accumulated


@compiled
def _set_axes(axes: Array, normal: Array, turn: Array, tangent: Array) -> None:
    """Writes a frame (3, 3) about a normal, from a tangent and the owner's transform (4, 4)."""
    along = 0.0
    for i in range(3):
        axes[i, 0] = turn[i, 0] * tangent[0] + turn[i, 1] * tangent[1] + turn[i, 2] * tangent[2]
        along += axes[i, 0] * normal[i]
    for i in range(3):
        axes[i, 0] -= along * normal[i]
        axes[i, 2] = normal[i]
    length = sqrt(axes[0, 0] ** 2 + axes[1, 0] ** 2 + axes[2, 0] ** 2)
    for i in range(3):
        axes[i, 0] /= length
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        axes[i, 1] = normal[j] * axes[k, 0] - normal[k] * axes[j, 0]


@compiled
def _set_map(
    matrix: Array, weight: float, arm: Array, turned: Array, normal: Array, length: float
) -> None:
    """Writes the map (6, 6) from a segment's motion to those of a point and its normal."""
    x, y, z = weight * arm[0], weight * arm[1], weight * arm[2]
    matrix[0, 4], matrix[0, 5] = z, -y
    matrix[1, 3], matrix[1, 5] = -z, x
    matrix[2, 3], matrix[2, 4] = y, -x
    along = normal[0] * turned[0] + normal[1] * turned[1] + normal[2] * turned[2]
    for i in range(3):
        matrix[i, i] = weight
        for j in range(3):
            # [n]x [m]x is m n^T - (n.m) I.
            matrix[3 + i, 3 + j] = -weight / length * turned[i] * normal[j]
        matrix[3 + i, 3 + i] += weight / length * along


@compiled
def _crossed(
    a: float, b: float, c: float, x: float, y: float, z: float
) -> tuple[float, float, float]:
    """Returns the cross product of two vectors."""
    return b * z - c * y, c * x - a * z, a * y - b * x
