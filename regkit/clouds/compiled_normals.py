"""Normals of many small neighbourhoods in compiled loops."""

from __future__ import annotations

from math import sqrt

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled


@compiled
def least_directions(points: Array, neighbours: Indices) -> Array:
    """Returns the direction of least variance of each neighbourhood, (N, 3).

    The eigenvectors of the covariance come from Jacobi rotations, which are accurate for any
    covariance, isotropic or degenerate.

    Args:
        points: The cloud, (P, 3) [m].
        neighbours: Indices of the k points of each neighbourhood, (N, k).
    """
    count, near = neighbours.shape
    directions = np.empty((count, 3))
    c, v, mean = np.empty((3, 3)), np.empty((3, 3)), np.empty(3)
    for n in range(count):
        for i in range(3):
            mean[i] = 0.0
            for k in range(near):
                mean[i] += points[neighbours[n, k], i]
            mean[i] /= near
        for i in range(3):
            for j in range(3):
                v[i, j] = 1.0 if i == j else 0.0
                c[i, j] = 0.0
                for k in range(near):
                    one = points[neighbours[n, k]]
                    c[i, j] += (one[i] - mean[i]) * (one[j] - mean[j])
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
        for i in range(3):
            directions[n, i] = v[i, least]
    return directions
