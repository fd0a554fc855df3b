"""The likelihood kernel, compiled; ``BoundLikelihood`` is its readable form."""

from __future__ import annotations

from math import log, pi, sqrt

import numpy as np

from regkit.gaussians.compiled_pairs import pair_moments, weighted_logarithms
from regkit.gaussians.compiled_similarity import (
    IS_FROZEN,
    LOG_WEIGHT,
    OWN,
    densities_now,
    start_view,
    view_now,
)
from regkit.gaussians.compiled_view import add_forces
from regkit.interfaces.compiled import SceneArrays
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Stack, Vector

OUTLIERS = OWN
"""Index of the fraction of outliers among the numbers."""


@compiled(python=False)
def bind(scene: SceneArrays, numbers: Vector, table: Matrix, state: Matrix) -> None:
    """Writes the logarithms of the mixture weights, and the density of outliers."""
    view = start_view(scene, numbers, state)
    count, scales = len(scene.weights), scene.primitives.scales
    total = 0.0
    for k in range(count):
        a, b, c = scales[k, 0], scales[k, 1], scales[k, 2]
        if len(view.reaches):
            area = 8.0 * pi * a * b * c / view.reaches[k, 0]
        else:
            area = 4.0 * pi * a * b * c / min(a, b, c)
        state[k, LOG_WEIGHT] = scene.weights[k] * area
        total += state[k, LOG_WEIGHT]
    outliers = numbers[OUTLIERS]
    share = (1.0 - outliers) / (2.0 * pi * sqrt(2.0 * pi)) / total
    for k in range(count):
        state[k, LOG_WEIGHT] = log(share * state[k, LOG_WEIGHT])
    state[count, 0] = outliers / _box_volume(scene.data.points)


@compiled(python=False)
def _box_volume(points: Matrix) -> float:
    """Returns the volume [m^3] of the points' bounding box; see ``box_volume``."""
    sides, longest = np.empty(3), 0.0
    for i in range(3):
        low = high = points[0, i]
        for j in range(len(points)):
            low, high = min(low, points[j, i]), max(high, points[j, i])
        sides[i] = high - low
        longest = max(longest, high - low)
    volume = 1.0
    for i in range(3):
        volume *= max(sides[i], 0.1 * longest)
    return volume


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
    """Returns minus the mean log-density, and adds its derivatives."""
    view = view_now(scene, centres, axes, numbers, state)
    count, weights = len(centres), scene.data.weights
    densities = np.empty((count, len(weights)), np.float32)
    total = np.empty(len(weights), np.float32)
    background = np.float32(state[count, 0])
    for j in range(len(total)):
        total[j] = background
    means = densities_now(scene, view, state, 0.0, densities, total)
    energy = -weighted_logarithms(weights, total)
    if order:
        for j in range(len(total)):
            total[j] = weights[j] / total[j]
        mass, about = np.empty(count), np.empty((count, 3, 4))
        pair_moments(scene.data.centred, means, densities, total, mass, about)
        frozen = numbers[IS_FROZEN] != 0.0
        add_forces(view, centres, mass, about, 0.0, frozen, order, wrenches, stiffness)
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
    """Writes the probability that each point is not an outlier."""
    view = view_now(scene, centres, axes, numbers, state)
    count = len(centres)
    densities = np.empty((count, len(probability)), np.float32)
    total = np.zeros(len(probability), np.float32)
    densities_now(scene, view, state, 0.0, densities, total)
    for j in range(len(probability)):
        probability[j] = total[j] / (total[j] + state[count, 0])
