"""The step between two poses, and forces on it, in compiled loops."""

from __future__ import annotations

from math import atan2, cos, sin, sqrt

import numpy as np

from regkit.skeleton.arrays import PoseArrays
from regkit.skeleton.compiled_steps import ball_steps
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Vector


@compiled
def pose_difference(start: PoseArrays, end: PoseArrays, dofs: int) -> Vector:
    """Returns the step (n,) with ``retract(start, step) = end``; see ``Skeleton.difference``."""
    hinges = dofs - len(end.hinges)
    first = hinges - 3 * len(end.balls)
    step = np.empty(dofs)
    if first == 6:
        for i in range(3):
            step[i] = end.root[i, 3] - start.root[i, 3]
        _write_turn(start.root, end.root, step)
    turns = ball_steps(start.balls, end.balls)
    for ball in range(len(turns)):
        for i in range(3):
            step[first + 3 * ball + i] = turns[ball, i]
    for hinge in range(len(end.hinges)):
        step[hinges + hinge] = end.hinges[hinge] - start.hinges[hinge]
    return step


@compiled(python=False)
def _write_turn(start: Matrix, end: Matrix, step: Vector) -> None:
    """Writes the rotation vector of R_start^T R_end into a step's entries 3 to 5."""
    turn = np.zeros((3, 3))
    for i in range(3):
        for j in range(3):
            for k in range(3):
                turn[i, j] += start[k, i] * end[k, j]
    trace = turn[0, 0] + turn[1, 1] + turn[2, 2]
    # The largest component of the quaternion is the pivot, so that nothing small divides.
    quaternion = np.empty(4)
    pivot, largest = 3, trace
    for i in range(3):
        if turn[i, i] > largest:
            pivot, largest = i, turn[i, i]
    if pivot == 3:
        quaternion[3] = 1.0 + trace
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            quaternion[i] = turn[k, j] - turn[j, k]
    else:
        j, k = (pivot + 1) % 3, (pivot + 2) % 3
        quaternion[pivot] = 1.0 + turn[pivot, pivot] - turn[j, j] - turn[k, k]
        quaternion[j] = turn[j, pivot] + turn[pivot, j]
        quaternion[k] = turn[k, pivot] + turn[pivot, k]
        quaternion[3] = turn[k, j] - turn[j, k]
    sign = -1.0 if quaternion[3] < 0.0 else 1.0
    sine = sqrt(quaternion[0] ** 2 + quaternion[1] ** 2 + quaternion[2] ** 2)
    cosine = sign * quaternion[3]
    scale = 2.0 / cosine if sine < 1e-6 * cosine else 2.0 * atan2(sine, cosine) / sine
    for i in range(3):
        step[3 + i] = sign * scale * quaternion[i]


@compiled
def add_at_end(step: Vector, pull: Vector, force: Vector, first: int, hinges: int) -> None:
    """Adds to a force at the end of a step the gradient ``pull`` to the step itself.

    A rotation vector w follows a rotation v of its end by J^-1 v with the right Jacobian J, and
    J^-T p = p - w x p / 2 + c w x (w x p).

    Args:
        step: The step, (n,).
        pull: Gradient to it, (n,).
        force: Added to, (n,).
        first: Index of the first rotation vector.
        hinges: Index of the first hinge.
    """
    for dof in range(first):
        force[dof] += pull[dof]
    for dof in range(hinges, len(step)):
        force[dof] += pull[dof]
    for at in range(first, hinges, 3):
        x, y, z = step[at], step[at + 1], step[at + 2]
        a, b, c = pull[at], pull[at + 1], pull[at + 2]
        square = x * x + y * y + z * z
        angle = sqrt(square)
        if angle < 1e-3:
            factor = 1.0 / 12.0 + square / 720.0
        else:
            factor = 1.0 / square - (1.0 + cos(angle)) / (2.0 * angle * sin(angle))
        along = x * a + y * b + z * c
        force[at] += a - 0.5 * (y * c - z * b) + factor * (x * along - square * a)
        force[at + 1] += b - 0.5 * (z * a - x * c) + factor * (y * along - square * b)
        force[at + 2] += c - 0.5 * (x * b - y * a) + factor * (z * along - square * c)
