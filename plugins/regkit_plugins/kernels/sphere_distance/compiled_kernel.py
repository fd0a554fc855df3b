"""The sphere-distance kernel, compiled; ``BoundSphereDistance`` is its readable form."""

from __future__ import annotations

from math import hypot, isnan, log, nan, sqrt

import numpy as np

from regkit.interfaces.compiled import SceneArrays
from regkit.registration.compiled_robust import SQUARES, loss_value, loss_weight
from regkit.system.compiled import compiled
from regkit.system.machine_types import IntegerVector, Matrix, Stack, Vector
from regkit_plugins.kernels.sphere_distance.compiled import nearest_capsules, residuals_and_rows

FRONT, LOSS, SCALE = 0, 1, 2
"""Indices of the numbers; the scale is NaN if each frame estimates it."""

HALF, RADIUS, SINE = 0, 1, 2
"""Columns of the table, which has a row for each capsule."""

_NORMAL_QUARTILE = 0.6744897501960817


@compiled(python=False)
def _residuals(
    scene: SceneArrays,
    centres: Matrix,
    axes: Stack,
    numbers: Vector,
    table: Matrix,
    state: Matrix,
    scale: float,
) -> tuple[IntegerVector, Vector, Matrix]:
    """Returns each point's capsule (N,), residual (N,) [m] and derivative (N, 6)."""
    count = len(centres)
    capsules, handicaps = np.empty((count, 9)), np.empty(count)
    for k in range(count):
        for i in range(3):
            capsules[k, i], capsules[k, 3 + i] = centres[k, i], axes[k, i, 1]
            capsules[k, 6 + i] = table[k, i]
        handicaps[k] = 2.0 * scale**2 * state[k, 0]
    points = scene.data.points
    owners, distances, places = nearest_capsules(points, capsules, handicaps)
    front = numbers[FRONT] != 0.0 and scene.data.camera
    residuals, rows = residuals_and_rows(points, capsules, owners, distances, places, front)
    return owners, residuals, rows


@compiled(python=False)
def _scale(numbers: Vector, residuals: Vector, deviation: float) -> float:
    """Returns the loss's scale [m]: the given one, or that of the residuals."""
    if not isnan(numbers[SCALE]):
        return float(numbers[SCALE])
    sizes = np.empty(len(residuals))
    for j in range(len(sizes)):
        sizes[j] = abs(residuals[j])
    return max(np.median(sizes) / _NORMAL_QUARTILE, deviation)


@compiled(python=False)
def bind(scene: SceneArrays, numbers: Vector, table: Matrix, state: Matrix) -> None:
    """Writes what the capsules' weights cost, and in the last row the loss's scale."""
    count, most = len(scene.weights), 0.0
    for k in range(count):
        most = max(most, scene.weights[k])
    for k in range(count):
        state[k, 0] = log(most / scene.weights[k])
    deviation = sqrt(scene.data.variance)
    _, residuals, _ = _residuals(scene, scene.centres, scene.axes, numbers, table, state, deviation)
    state[count, 0] = hypot(_scale(numbers, residuals, deviation), scene.smoothing)


@compiled(python=False)
def respond(
    scene: SceneArrays,
    centres: Matrix,
    axes: Stack,
    numbers: Vector,
    table: Matrix,
    state: Matrix,
    order: int,
    wrenches: Matrix,
    stiffness: Stack,
) -> float:
    """Returns the mean loss of the distances, and adds its derivatives."""
    scale = state[len(centres), 0]
    owners, residuals, rows = _residuals(scene, centres, axes, numbers, table, state, scale)
    energy, weights = log(scale / sqrt(scene.data.variance)), scene.data.weights
    for j in range(len(residuals)):
        k, square = owners[j], (residuals[j] / scale) ** 2
        energy += weights[j] * (loss_value(numbers[LOSS], square) + state[k, 0])
        if order:
            weight = weights[j] * loss_weight(numbers[LOSS], square) / scale**2
            for a in range(6):
                scaled = weight * rows[j, a]
                wrenches[k, a] += scaled * residuals[j]
                for b in range(6):
                    stiffness[k, a, b] += scaled * rows[j, b]
    return energy


@compiled(python=False)
def explain(
    scene: SceneArrays,
    centres: Matrix,
    axes: Stack,
    numbers: Vector,
    table: Matrix,
    state: Matrix,
    probability: Vector,
) -> None:
    """Writes the loss's weight of each distance, on the scale of this pose; NaN for squares."""
    scale = state[len(centres), 0]
    _, residuals, _ = _residuals(scene, centres, axes, numbers, table, state, scale)
    scale = _scale(numbers, residuals, sqrt(scene.data.variance))
    for j in range(len(residuals)):
        square = (residuals[j] / scale) ** 2
        probability[j] = nan if numbers[LOSS] == SQUARES else loss_weight(numbers[LOSS], square)
