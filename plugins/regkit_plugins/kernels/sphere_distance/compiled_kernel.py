"""The sphere-distance kernel, compiled; ``BoundSphereDistance`` is its readable form."""

from __future__ import annotations

from math import hypot, isnan, log, nan, sqrt

import numpy as np

from regkit.interfaces.compiled import SceneArrays
from regkit.registration.compiled_robust import SQUARES, write_losses
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, SingleMatrix, SingleVector, Stack, Vector
from regkit_plugins.kernels.sphere_distance.compiled_capsule import (
    add_derivatives,
    write_residuals,
)
from regkit_plugins.kernels.sphere_distance.compiled_owners import (
    GroupedPoints,
    grouped_points,
    likely_capsules,
)

FRONT, LOSS, SCALE = 0, 1, 2
"""Indices of the numbers; the scale is NaN if each frame estimates it."""

HALF, RADIUS, SINE = 0, 1, 2
"""Columns of the table, which has a row for each capsule."""

_NORMAL_QUARTILE = 0.6744897501960817


@compiled(python=False)
def _capsules(scene: SceneArrays, centres: Matrix, axes: Stack, table: Matrix) -> SingleMatrix:
    """Returns the capsules in a pose, (K, 10); see ``compiled_owners``."""
    capsules = np.empty((len(centres), 10), np.float32)
    for k in range(len(centres)):
        for i in range(3):
            capsules[k, i] = centres[k, i] - scene.data.centre[i]
            capsules[k, 3 + i] = axes[k, i, 1]
            capsules[k, 6 + i] = table[k, i]
        capsules[k, 9] = table[k, SINE] / sqrt(1.0 - table[k, SINE] ** 2)
    return capsules


@compiled(python=False)
def _eye(scene: SceneArrays, numbers: Vector) -> SingleVector:
    """Returns the camera's position relative to the data's centre and whether it counts, (4,)."""
    eye = np.empty(4, np.float32)
    for i in range(3):
        eye[i] = -scene.data.centre[i]
    eye[3] = 1.0 if numbers[FRONT] != 0.0 and scene.data.camera else 0.0
    return eye


@compiled(python=False)
def _grouped(
    scene: SceneArrays, capsules: SingleMatrix, state: Matrix, scale: float
) -> GroupedPoints:
    """Returns the points in the order of their capsules."""
    count = len(capsules)
    handicaps = np.empty(count)
    for k in range(count):
        handicaps[k] = 2.0 * scale**2 * state[k, 0]
    owners = likely_capsules(scene.data.centred, capsules, handicaps)
    return grouped_points(scene.data, owners, count)


@compiled(python=False)
def _residuals(points: GroupedPoints, capsules: SingleMatrix, eye: SingleVector) -> SingleVector:
    """Returns the residuals of grouped points, (N,) [m]."""
    residuals, ends = np.empty(len(points.numbers), np.float32), points.ends
    for k in range(len(capsules)):
        if ends[k] < ends[k + 1]:
            write_residuals(points.places, capsules[k], eye, ends[k], ends[k + 1], residuals)
    return residuals


@compiled(python=False)
def _scale(numbers: Vector, residuals: SingleVector, deviation: float) -> float:
    """Returns the loss's scale [m]: the given one, or that of the residuals."""
    if not isnan(numbers[SCALE]):
        return float(numbers[SCALE])
    sizes = np.empty(len(residuals), np.float32)
    for j in range(len(sizes)):
        sizes[j] = abs(residuals[j])
    return max(float(np.median(sizes)) / _NORMAL_QUARTILE, deviation)


@compiled(python=False)
def bind(scene: SceneArrays, numbers: Vector, table: Matrix, state: Matrix) -> None:
    """Writes what the capsules' weights cost, and in the last row the loss's scale."""
    count, most = len(scene.weights), 0.0
    for k in range(count):
        most = max(most, scene.weights[k])
    for k in range(count):
        state[k, 0] = log(most / scene.weights[k])
    deviation = sqrt(scene.data.variance)
    capsules = _capsules(scene, scene.centres, scene.axes, table)
    points = _grouped(scene, capsules, state, deviation)
    residuals = _residuals(points, capsules, _eye(scene, numbers))
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
    capsules, eye = _capsules(scene, centres, axes, table), _eye(scene, numbers)
    points = _grouped(scene, capsules, state, scale)
    residuals, ends = _residuals(points, capsules, eye), points.ends
    values, factors = np.empty(len(residuals), np.float32), np.empty(len(residuals), np.float32)
    write_losses(numbers[LOSS], residuals, scale, values, factors)
    energy = log(scale / sqrt(scene.data.variance))
    for k in range(len(capsules)):
        first, last = ends[k], ends[k + 1]
        for j in range(first, last):
            energy += points.weights[j] * (values[j] + state[k, 0])
            factors[j] *= points.weights[j] / scale**2
        if order and first < last:
            add_derivatives(
                points.places,
                capsules[k],
                eye,
                first,
                last,
                residuals,
                factors,
                wrenches[k],
                stiffness[k],
            )
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
    capsules = _capsules(scene, centres, axes, table)
    points = _grouped(scene, capsules, state, state[len(centres), 0])
    residuals = _residuals(points, capsules, _eye(scene, numbers))
    scale = _scale(numbers, residuals, sqrt(scene.data.variance))
    values, factors = np.empty(len(residuals), np.float32), np.empty(len(residuals), np.float32)
    write_losses(numbers[LOSS], residuals, scale, values, factors)
    for j in range(len(residuals)):
        probability[points.numbers[j]] = nan if numbers[LOSS] == SQUARES else factors[j]
