"""Normals of many small neighbourhoods in compiled loops."""

from __future__ import annotations

from math import acos, cos, pi, sqrt

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled

DISTINCT = 1e-2
"""Where the least two variances are closer, relative to the others, an eigenvalue in closed form is
not exact enough."""


@compiled
def least_directions(points: Array, neighbours: Indices) -> Array:
    """Returns the direction of least variance of each neighbourhood, (N, 3).

    It is orthogonal to two rows of C - l I, where l is the least eigenvalue of the covariance C
    (Smith, Eigenvalues of a symmetric 3x3 matrix, 1961).

    Args:
        points: The cloud, (P, 3) [m].
        neighbours: Indices of the k points of each neighbourhood, (N, k).
    """
    count, near = neighbours.shape
    directions = np.empty((count, 3))
    for n in range(count):
        x = y = z = 0.0
        for k in range(near):
            i = neighbours[n, k]
            x += points[i, 0]
            y += points[i, 1]
            z += points[i, 2]
        x, y, z = x / near, y / near, z / near
        xx = yy = zz = xy = xz = yz = 0.0
        for k in range(near):
            i = neighbours[n, k]
            p, q, r = points[i, 0] - x, points[i, 1] - y, points[i, 2] - z
            xx += p * p
            yy += q * q
            zz += r * r
            xy += p * q
            xz += p * r
            yz += q * r
        mean = (xx + yy + zz) / 3.0
        p, q, r = xx - mean, yy - mean, zz - mean
        square = (p * p + q * q + r * r + 2.0 * (xy * xy + xz * xz + yz * yz)) / 6.0
        size = sqrt(square)
        best = 0.0
        if size > 0.0:
            half = p * (q * r - yz * yz) - xy * (xy * r - yz * xz) + xz * (xy * yz - q * xz)
            half = min(max(0.5 * half / (square * size), -1.0), 1.0)
            least = 2.0 * size * cos(acos(half) / 3.0 + 2.0 * pi / 3.0)
            p, q, r = p - least, q - least, r - least
            # The longest of the three products of two rows has the least rounding errors.
            for pair in range(3):
                if pair == 0:
                    x, y, z = xy * yz - xz * q, xz * xy - p * yz, p * q - xy * xy
                elif pair == 1:
                    x, y, z = xy * r - xz * yz, xz * xz - p * r, p * yz - xy * xz
                else:
                    x, y, z = q * r - yz * yz, yz * xz - xy * r, xy * yz - q * xz
                length = sqrt(x * x + y * y + z * z)
                if length > best:
                    best = length
                    directions[n, 0], directions[n, 1] = x / length, y / length
                    directions[n, 2] = z / length
        if best <= DISTINCT * square:
            directions[n] = least_eigenvector(xx, yy, zz, xy, xz, yz)
    return directions


@compiled
def least_eigenvector(xx: float, yy: float, zz: float, xy: float, xz: float, yz: float) -> Array:
    """Returns the unit eigenvector (3,) of the least eigenvalue of a symmetric matrix.

    Jacobi rotations are accurate for any covariance, isotropic or degenerate.
    """
    c, v = np.empty((3, 3)), np.eye(3)
    c[0, 0], c[1, 1], c[2, 2] = xx, yy, zz
    c[0, 1] = c[1, 0] = xy
    c[0, 2] = c[2, 0] = xz
    c[1, 2] = c[2, 1] = yz
    for _ in range(12):
        off = c[0, 1] ** 2 + c[0, 2] ** 2 + c[1, 2] ** 2
        if off <= 1e-24 * (c[0, 0] + c[1, 1] + c[2, 2]) ** 2:
            break
        for p in range(2):
            for q in range(p + 1, 3):
                if c[p, q] == 0.0:
                    continue
                ratio = (c[q, q] - c[p, p]) / (2.0 * c[p, q])
                sign = 1.0 if ratio >= 0.0 else -1.0
                tangent = sign / (abs(ratio) + sqrt(ratio * ratio + 1.0))
                cosine = 1.0 / sqrt(tangent * tangent + 1.0)
                sine = tangent * cosine
                for i in range(3):
                    first, second = c[i, p], c[i, q]
                    c[i, p] = cosine * first - sine * second
                    c[i, q] = sine * first + cosine * second
                for i in range(3):
                    first, second = c[p, i], c[q, i]
                    c[p, i] = cosine * first - sine * second
                    c[q, i] = sine * first + cosine * second
                for i in range(3):
                    first, second = v[i, p], v[i, q]
                    v[i, p] = cosine * first - sine * second
                    v[i, q] = sine * first + cosine * second
    least = 0
    for i in range(1, 3):
        if c[i, i] < c[least, least]:
            least = i
    return v[:, least].copy()
