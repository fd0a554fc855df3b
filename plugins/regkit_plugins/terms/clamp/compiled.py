"""The clamp term, compiled; ``BoundClamp`` is its readable form."""

from __future__ import annotations

from math import log

import numpy as np

from regkit.gaussians.compiled_pairs import pair_moments
from regkit.gaussians.compiled_similarity import (
    IS_FROZEN,
    LOG_WEIGHT,
    OWN,
    densities_now,
    start_view,
    view_now,
)
from regkit.gaussians.compiled_view import add_forces
from regkit.gaussians.overlap import SELF_OVERLAP
from regkit.interfaces.compiled import SceneArrays
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Stack, Vector

WEIGHT = OWN
"""Index of the term's weight among the numbers."""


@compiled(python=False)
def bind(scene: SceneArrays, numbers: Vector, table: Matrix, state: Matrix) -> None:
    """Writes the logarithms of the weights, without visibility."""
    start_view(scene, numbers, state)
    for k in range(len(scene.weights)):
        state[k, LOG_WEIGHT] = log(scene.primitives.weights[k])


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
    """Returns the overlap beyond the self-overlap; it adds no blocks, which are not positive."""
    view = view_now(scene, centres, axes, numbers, state)
    count, weights = len(centres), scene.data.weights
    densities = np.empty((count, len(weights)), np.float32)
    total = np.zeros(len(weights), np.float32)
    means = densities_now(scene, view, state, 1.0, densities, total)
    energy, weight = 0.0, numbers[WEIGHT]
    for j in range(len(total)):
        excess = total[j] - SELF_OVERLAP
        total[j] = 0.0
        if excess > 0.0:
            energy += weight * weights[j] * excess
            total[j] = -weight * weights[j]
    if order:
        mass, about = np.empty(count), np.empty((count, 3, 4))
        pair_moments(scene.data.centred, means, densities, total, mass, about)
        frozen = numbers[IS_FROZEN] != 0.0
        add_forces(view, centres, mass, about, 1.0, frozen, 1, wrenches, stiffness)
    return energy
