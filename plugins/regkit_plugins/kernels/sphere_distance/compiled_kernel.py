"""The sphere-distance kernel, compiled; ``BoundSphereDistance`` is its readable form."""

from __future__ import annotations

from math import hypot, isnan, log, nan, sqrt

import numpy as np

from regkit.interfaces.compiled import SceneArrays
from regkit.registration.compiled_robust import SQUARES, loss_value, loss_weight
from regkit.system.compiled import compiled
from regkit.system.machine_types import IntegerVector, Matrix, Stack, Vector
from regkit_plugins.kernels.sphere_distance.compiled import residuals_and_rows
from regkit_plugins.kernels.sphere_distance.compiled_owners import (
    capsule_distances,
    likely_capsules,
)

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
    rows: Matrix,
) -> tuple[IntegerVector, Vector]:
    """Returns each point's capsule (N,) and residual (N,) [m]; see ``residuals_and_rows``."""
    count, data = len(centres), scene.data
    capsules, handicaps = np.empty((count, 9)), np.empty(count)
    for k in range(count):
        for i in range(3):
            capsules[k, i], capsules[k, 3 + i] = centres[k, i], axes[k, i, 1]
            capsules[k, 6 + i] = table[k, i]
        handicaps[k] = 2.0 * scale**2 * state[k, 0]
    owners = likely_capsules(data.centred, data.centre, capsules, handicaps)
    distances, places = capsule_distances(data.points, capsules, owners)
    front = numbers[FRONT] != 0.0 and data.camera
    residuals = residuals_and_rows(data.points, capsules, owners, distances, places, front, rows)
    return owners, residuals


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
    _, residuals = _residuals(
        scene, scene.centres, scene.axes, numbers, table, state, deviation, np.empty((0, 6))
    )
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
    rows = np.empty((len(scene.data.points) if order else 0, 6))
    owners, residuals = _residuals(scene, centres, axes, numbers, table, state, scale, rows)
    energy, weights = log(scale / sqrt(scene.data.variance)), scene.data.weights
    factors = np.empty(len(residuals))
    for j in range(len(residuals)):
        square = (residuals[j] / scale) ** 2
        energy += weights[j] * (loss_value(numbers[LOSS], square) + state[owners[j], 0])
        factors[j] = weights[j] * loss_weight(numbers[LOSS], square) / scale**2
    if order:
        add_residuals(owners, residuals, rows, factors, wrenches, stiffness)
    return energy


@compiled(reordered=True, python=False)
def add_residuals(
    owners: IntegerVector,
    residuals: Vector,
    rows: Matrix,
    factors: Vector,
    wrenches: Matrix,
    stiffness: Stack,
) -> None:
    """Adds w J^T r (K, 6) and w J^T J (K, 6, 6) of the residuals of each capsule."""
    blocks = np.zeros((len(wrenches), 6, 6))
    for j in range(len(owners)):
        k = owners[j]
        for a in range(6):
            scaled = factors[j] * rows[j, a]
            wrenches[k, a] += scaled * residuals[j]
            for b in range(a + 1):
                blocks[k, a, b] += scaled * rows[j, b]
    for k in range(len(blocks)):
        for a in range(6):
            for b in range(6):
                stiffness[k, a, b] += blocks[k, max(a, b), min(a, b)]


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
    rows = np.empty((0, 6))
    _, residuals = _residuals(scene, centres, axes, numbers, table, state, scale, rows)
    scale = _scale(numbers, residuals, sqrt(scene.data.variance))
    for j in range(len(residuals)):
        square = (residuals[j] / scale) ** 2
        probability[j] = nan if numbers[LOSS] == SQUARES else loss_weight(numbers[LOSS], square)
