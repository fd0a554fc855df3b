"""The overlap of Gaussians, compiled; ``Overlap`` is its readable form."""

from __future__ import annotations

from math import log

import numpy as np

from regkit.gaussians.compiled_pairs import pair_moments, weighted_sum
from regkit.gaussians.compiled_similarity import (
    IS_FROZEN,
    LOG_WEIGHT,
    densities_now,
    start_view,
    view_now,
)
from regkit.gaussians.compiled_view import add_forces
from regkit.gaussians.overlap import SELF_OVERLAP
from regkit.interfaces.compiled import SceneArrays
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Stack, Vector


@compiled(python=False)
def bind(scene: SceneArrays, numbers: Vector, table: Matrix, state: Matrix) -> None:
    """Writes the logarithms of the weights."""
    start_view(scene, numbers, state)
    for k in range(len(scene.weights)):
        state[k, LOG_WEIGHT] = log(scene.weights[k])


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
    """Returns minus the mean overlap of the data, and adds its derivatives."""
    view = view_now(scene, centres, axes, numbers, state)
    count, weights = len(centres), scene.data.weights
    densities = np.empty((count, len(weights)), np.float32)
    total = np.zeros(len(weights), np.float32)
    means = densities_now(scene, view, state, 1.0, densities, total)
    if order == 0:
        return -weighted_sum(weights, total)
    mass, about = np.empty(count), np.empty((count, 3, 4))
    pair_moments(scene.data.centred, means, densities, weights, mass, about)
    frozen = numbers[IS_FROZEN] != 0.0
    add_forces(view, centres, mass, about, 1.0, frozen, order, wrenches, stiffness)
    energy = 0.0
    for k in range(count):
        energy -= mass[k]
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
    """Writes each point's overlap as a fraction of its self-overlap, at most 1."""
    view = view_now(scene, centres, axes, numbers, state)
    densities = np.empty((len(centres), len(probability)), np.float32)
    total = np.zeros(len(probability), np.float32)
    densities_now(scene, view, state, 1.0, densities, total)
    for j in range(len(probability)):
        probability[j] = min(total[j] / SELF_OVERLAP, 1.0)
