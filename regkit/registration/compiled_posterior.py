"""The covariance of a registered pose, compiled; see ``PoseCurvature``."""

from __future__ import annotations

from math import sqrt

import numpy as np

from regkit.registration.compiled_problem import through_couplings
from regkit.skeleton.arrays import LimitArrays, PoseArrays, SkeletonArrays
from regkit.skeleton.compiled_steps import ball_steps, retracted_balls, step_jacobian, within_limits
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Vector

NUDGE = 1e-3
"""Rotation against a ball joint's limit [rad] that tells whether the limit is active."""

NEAR = 1e-9
"""A hinge that is nearer to its limit is at it [rad]."""


@compiled
def to_tangent(x: Vector, first: int, hinges: int, gradient: Vector, matrix: Matrix) -> None:
    """Replaces derivatives to coordinates x by those to a step from the pose at x, in place.

    With x + dx at the step B dx, a gradient becomes B^-T g and a matrix B^-T H B^-1.

    Args:
        x: Coordinates, (m,).
        first: Index of the first rotation vector in x.
        hinges: Index of the first hinge in x.
        gradient: Replaced, (m,).
        matrix: Replaced, (m, m).
    """
    blocks, count = step_jacobian(x, first, hinges), len(x)
    inverse = np.empty((3, 3))
    for a in range(first, hinges, 3):
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            for p in range(3):
                q, r = (p + 1) % 3, (p + 2) % 3
                inverse[p, i] = (
                    blocks[a + j, a + q] * blocks[a + k, a + r]
                    - blocks[a + j, a + r] * blocks[a + k, a + q]
                )
        determinant = 0.0
        for i in range(3):
            determinant += blocks[a, a + i] * inverse[i, 0]
        for i in range(3):
            for j in range(3):
                inverse[i, j] /= determinant
        for row in range(count):
            u, v, w = matrix[row, a], matrix[row, a + 1], matrix[row, a + 2]
            for i in range(3):
                matrix[row, a + i] = u * inverse[0, i] + v * inverse[1, i] + w * inverse[2, i]
        for column in range(count):
            u, v, w = matrix[a, column], matrix[a + 1, column], matrix[a + 2, column]
            for i in range(3):
                matrix[a + i, column] = u * inverse[0, i] + v * inverse[1, i] + w * inverse[2, i]
        u, v, w = gradient[a], gradient[a + 1], gradient[a + 2]
        for i in range(3):
            gradient[a + i] = u * inverse[0, i] + v * inverse[1, i] + w * inverse[2, i]


@compiled
def add_active_limits(
    skeleton: SkeletonArrays, pose: PoseArrays, gradient: Vector, matrix: Matrix
) -> None:
    """Adds the information of the limits against which minus the log-likelihood presses.

    On the inner side of a limit that is pressed with the force f, the density falls as exp(-f d)
    with the distance d, which has the second moment 2 / f^2: the limit adds f^2 / 2 along its
    normal. A joint that is pressed hard has no variance left.

    Args:
        skeleton: The skeleton.
        pose: The pose, within the limits.
        gradient: Gradient of minus the log-likelihood on the independent dofs, (m,).
        matrix: Added to, (m, m).
    """
    first, limits, count = skeleton.first, skeleton.limits, len(pose.balls)
    turns, pressing = np.zeros((count, 3)), np.zeros(count)
    for ball in range(count):
        at = first + 3 * ball
        for i in range(3):
            pressing[ball] += gradient[at + i] ** 2
        pressing[ball] = sqrt(pressing[ball])
        for i in range(3):
            if pressing[ball] > 0.0:
                turns[ball, i] = -NUDGE * gradient[at + i] / pressing[ball]
    pressed = retracted_balls(pose.balls, turns)
    back, turned = within_limits(
        pressed, limits.centres, limits.twist_axes, limits.cones, limits.twists
    )
    if turned:
        beyond = ball_steps(back, pressed)
        for ball in range(count):
            at, size = first + 3 * ball, 0.0
            for i in range(3):
                size += beyond[ball, i] ** 2
            if size <= (1e-3 * NUDGE) ** 2:
                continue
            force = 0.0
            for i in range(3):
                force -= gradient[at + i] * beyond[ball, i] / sqrt(size)
            for i in range(3):
                for j in range(3):
                    share = beyond[ball, i] * beyond[ball, j] / size
                    matrix[at + i, at + j] += 0.5 * force * force * share
    hinges = first + 3 * count
    for hinge in range(len(pose.hinges)):
        if limits.leaders[hinge] != hinge:
            continue
        at, angle = hinges + limits.variables[hinge], pose.hinges[hinge]
        low = angle <= limits.hinges[hinge, 0] + NEAR and gradient[at] > 0.0
        high = angle >= limits.hinges[hinge, 1] - NEAR and gradient[at] < 0.0
        if low or high:
            matrix[at, at] += 0.5 * gradient[at] ** 2


@compiled
def contracted(limits: LimitArrays, hinges: int, square: Matrix, count: int) -> Matrix:
    """Returns K^T A K (m, m) of a matrix A (n, n) with the couplings K, (n, m)."""
    gradient, matrix = np.empty(count), np.empty((count, count))
    through_couplings(limits, hinges, np.zeros(len(square)), square, gradient, matrix)
    return matrix


@compiled
def expanded(limits: LimitArrays, hinges: int, matrix: Matrix) -> Matrix:
    """Returns K P K^T (n, n) of a covariance P (m, m) with the couplings K, (n, m)."""
    dofs = hinges + len(limits.leaders)
    if dofs == len(matrix):
        return matrix
    at, share = np.arange(dofs), np.ones(dofs)
    for hinge in range(len(limits.leaders)):
        at[hinges + hinge] = hinges + limits.variables[hinge]
        share[hinges + hinge] = limits.ratios[hinge]
    wide = np.empty((dofs, dofs))
    for i in range(dofs):
        for j in range(dofs):
            wide[i, j] = share[i] * share[j] * matrix[at[i], at[j]]
    return wide


@compiled(reordered=True)
def inverted(matrix: Matrix) -> Matrix:
    """Returns the inverse (m, m) of a symmetric matrix; NaN if it is not positive definite.

    This is the sweep operator on the upper triangle, which turns A into -A^-1 row by row: for some
    thirty rows it is faster than a factorisation.
    """
    count = len(matrix)
    swept, row = matrix.copy(), np.empty(count)
    for p in range(count):
        pivot = swept[p, p]
        if not pivot > 0.0:
            return np.full((count, count), np.nan)
        for i in range(p):
            row[i] = swept[i, p]
        for i in range(p, count):
            row[i] = swept[p, i]
        row[p] = 0.0
        for i in range(count):
            share = row[i] / pivot
            for j in range(i, count):
                swept[i, j] -= share * row[j]
        for i in range(p):
            swept[i, p] = row[i] / pivot
        for i in range(p + 1, count):
            swept[p, i] = row[i] / pivot
        swept[p, p] = -1.0 / pivot
    for i in range(count):
        for j in range(i, count):
            swept[i, j] = swept[j, i] = -swept[i, j]
    return swept
