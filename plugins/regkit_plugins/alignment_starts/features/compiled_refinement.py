"""Refinement of a motion by distances of surfaces, with neighbours looked up in a grid."""

from __future__ import annotations

from math import cos, sin, sqrt

import numpy as np

from regkit.system.arrays import Array
from regkit.system.compiled import compiled
from regkit_plugins.alignment_starts.features.compiled_scores import nearest_to
from regkit_plugins.alignment_starts.features.compiled_surroundings import Surroundings

LEAST_COSINE = 0.6
"""Cosine between normals below which two points are no pair."""


@compiled
def refined(
    motion: Array, points: Array, normals: Array, other: Surroundings, within: float, steps: int
) -> Array:
    """Returns a motion (3, 4) after steps of symmetric point-to-plane registration.

    The distance is along the sum of both normals (Rusinkiewicz, A symmetric objective function for
    ICP, 2019, eq. 4), weighted by Tukey's function of the distance of the points.

    Args:
        motion: The motion, (3, 4).
        points: Points that it moves, (N, 3) [m].
        normals: Their normals, (N, 3).
        other: The cloud to which they are moved.
        within: Distance of points beyond which they are no pair [m].
        steps: Greatest number of steps.
    """
    motion = motion.copy()
    for _ in range(steps):
        matrix, gradient = _equations(motion, points, normals, other, within)
        scale = 0.0
        for i in range(6):
            scale += matrix[i, i]
        if scale == 0.0:
            break
        for i in range(6):
            matrix[i, i] += 1e-6 * matrix[i, i] + 1e-9 * scale
        step = -np.linalg.solve(matrix, gradient)
        _move(motion, step)
        turn = sqrt(step[3] ** 2 + step[4] ** 2 + step[5] ** 2)
        if turn < 1e-3 and sqrt(step[0] ** 2 + step[1] ** 2 + step[2] ** 2) < 0.01 * within:
            break
    return motion


@compiled(reordered=True)
def _equations(
    motion: Array, points: Array, normals: Array, other: Surroundings, within: float
) -> tuple[Array, Array]:
    """Returns the normal equations: a matrix (6, 6) and a gradient (6,), translation first."""
    matrix, gradient, row = np.zeros((6, 6)), np.zeros(6), np.empty(6)
    for n in range(len(points)):
        a, b, c = points[n, 0], points[n, 1], points[n, 2]
        x = motion[0, 0] * a + motion[0, 1] * b + motion[0, 2] * c + motion[0, 3]
        y = motion[1, 0] * a + motion[1, 1] * b + motion[1, 2] * c + motion[1, 3]
        z = motion[2, 0] * a + motion[2, 1] * b + motion[2, 2] * c + motion[2, 3]
        index = nearest_to(other, x, y, z)
        if index < 0:
            continue
        u, v = x - other.points[index, 0], y - other.points[index, 1]
        w = z - other.points[index, 2]
        share = (u * u + v * v + w * w) / (within * within)
        a, b, c = normals[n, 0], normals[n, 1], normals[n, 2]
        d = motion[0, 0] * a + motion[0, 1] * b + motion[0, 2] * c
        e = motion[1, 0] * a + motion[1, 1] * b + motion[1, 2] * c
        f = motion[2, 0] * a + motion[2, 1] * b + motion[2, 2] * c
        p, q, r = other.normals[index, 0], other.normals[index, 1], other.normals[index, 2]
        cosine = d * p + e * q + f * r
        if share >= 1.0 or cosine < LEAST_COSINE:
            continue
        d, e, f = d + p, e + q, f + r
        length = sqrt(d * d + e * e + f * f)
        d, e, f = d / length, e / length, f / length
        off, weight = u * d + v * e + w * f, cosine * (1.0 - share) ** 2
        row[0], row[1], row[2] = d, e, f
        row[3], row[4], row[5] = y * f - z * e, z * d - x * f, x * e - y * d
        for i in range(6):
            gradient[i] += weight * row[i] * off
            for j in range(6):
                matrix[i, j] += weight * row[i] * row[j]
    return matrix, gradient


@compiled
def _move(motion: Array, step: Array) -> None:
    """Moves a motion (3, 4) by a twist (6,) in the target's frame, translation first."""
    angle = sqrt(step[3] ** 2 + step[4] ** 2 + step[5] ** 2)
    turn = np.eye(3)
    if angle > 1e-12:
        x, y, z = step[3] / angle, step[4] / angle, step[5] / angle
        s, c = sin(angle), cos(angle)
        rest = 1.0 - c
        turn[0, 0], turn[1, 1], turn[2, 2] = c + x * x * rest, c + y * y * rest, c + z * z * rest
        turn[0, 1], turn[1, 0] = x * y * rest - z * s, x * y * rest + z * s
        turn[0, 2], turn[2, 0] = x * z * rest + y * s, x * z * rest - y * s
        turn[1, 2], turn[2, 1] = y * z * rest - x * s, y * z * rest + x * s
    before = motion.copy()
    for i in range(3):
        for j in range(4):
            motion[i, j] = step[i] if j == 3 else 0.0
            for k in range(3):
                motion[i, j] += turn[i, k] * before[k, j]
