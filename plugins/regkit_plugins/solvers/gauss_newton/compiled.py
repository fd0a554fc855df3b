"""Damped Gauss-Newton, compiled; ``GaussNewton.minimize`` is its readable form."""

from __future__ import annotations

from math import isfinite, sqrt

import numpy as np

from regkit.registration.compiled_problem import ProblemArrays, equations, project
from regkit.system.compiled import compiled
from regkit.system.machine_types import IntegerVector, Matrix, Vector

MESSAGES = (
    "the energy or its gradient at the start is not finite",
    "the gradient is zero",
    "the value converged",
    "no step decreases the value",
    "max_iterations reached",
)
"""Reasons to end, by number; the first is an error."""

NOT_FINITE, ZERO, CONVERGED, STUCK, ENDED = range(5)

MAX_ITERATIONS, VALUE_TOLERANCE, DAMPING, RESTING = range(4)
"""Indices of the settings."""


@compiled
def minimize(
    problem: ProblemArrays, settings: Vector, x: Vector, gradient: Vector, matrix: Matrix
) -> tuple[float, int, int, int]:
    """Moves x (m,) to the minimum; returns the value, iterations, evaluations and the reason.

    Args:
        problem: The problem.
        settings: The settings, in the order of their indices.
        x: The start, replaced by the last accepted point.
        gradient: Written, the gradient there, (m,).
        matrix: Written, the Gauss-Newton matrix there, (m, m).
    """
    count = len(x)
    project(problem.skeleton, problem.start, x)
    value = equations(problem, x, gradient, matrix)
    if not (isfinite(value) and _are_finite(gradient, matrix)):
        return value, 0, 1, NOT_FINITE
    first, damping, evaluations = value, settings[DAMPING], 1
    free, step = np.empty(count, np.int64), np.empty(count)
    trial, trial_gradient = np.empty(count), np.empty(count)
    trial_matrix = np.empty((count, count))
    iterations = int(settings[MAX_ITERATIONS])
    for iteration in range(iterations):
        moving, strongest = 0, 0.0
        for i in range(count):
            low = x[i] <= problem.lower[i] and gradient[i] > 0.0
            high = x[i] >= problem.upper[i] and gradient[i] < 0.0
            if not (low or high):
                free[moving] = i
                moving += 1
                strongest = max(strongest, abs(gradient[i]))
        if strongest == 0.0:
            return value, iteration, evaluations, ZERO
        for i in range(count):
            trial[i] = x[i]
        solved = _damped_step(
            gradient, matrix, free, moving, strongest, damping, settings[RESTING], step
        )
        trial_value = value
        if solved:
            for i in range(moving):
                trial[free[i]] += step[i]
            project(problem.skeleton, problem.start, trial)
            trial_value = equations(problem, trial, trial_gradient, trial_matrix)
            evaluations += 1
        gain = value - trial_value
        if gain > 0.0 and _are_finite(trial_gradient, trial_matrix):
            value = trial_value
            for i in range(count):
                x[i] = trial[i]
                gradient[i] = trial_gradient[i]
                for j in range(count):
                    matrix[i, j] = trial_matrix[i, j]
            damping = max(0.2 * damping, 1e-9)
            if gain <= settings[VALUE_TOLERANCE] * (first - value):
                return value, iteration + 1, evaluations, CONVERGED
        elif damping > 1e9:
            return value, iteration, evaluations, STUCK
        else:
            damping *= 10.0
    return value, iterations, evaluations, ENDED


@compiled(python=False)
def _are_finite(gradient: Vector, matrix: Matrix) -> bool:
    """Returns whether all entries are finite."""
    total = 0.0
    for i in range(len(gradient)):
        total += 0.0 * gradient[i]
        for j in range(len(gradient)):
            total += 0.0 * matrix[i, j]
    return total == 0.0


@compiled(reordered=True, python=False)
def _damped_step(
    gradient: Vector,
    matrix: Matrix,
    free: IntegerVector,
    moving: int,
    strongest: float,
    damping: float,
    resting: float,
    step: Vector,
) -> bool:
    """Writes the step of the free variables; returns whether the matrix is positive definite."""
    mean = 0.0
    for i in range(moving):
        mean += matrix[free[i], free[i]] / moving
    factor = np.empty((moving, moving))
    for i in range(moving):
        for j in range(i + 1):
            entry = matrix[free[i], free[j]]
            if i == j:
                entry += damping * (entry + strongest) + resting * mean
            for k in range(j):
                entry -= factor[i, k] * factor[j, k]
            if i == j:
                if not entry > 0.0:
                    return False
                factor[i, i] = sqrt(entry)
            else:
                factor[i, j] = entry / factor[j, j]
    for i in range(moving):
        entry = -gradient[free[i]]
        for k in range(i):
            entry -= factor[i, k] * step[k]
        step[i] = entry / factor[i, i]
    for i in range(moving - 1, -1, -1):
        entry = step[i]
        for k in range(i + 1, moving):
            entry -= factor[k, i] * step[k]
        step[i] = entry / factor[i, i]
    return True
