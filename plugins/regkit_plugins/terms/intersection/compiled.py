"""Overlaps of pairs of primitives, in compiled loops, and the whole term, compiled."""

from __future__ import annotations

from math import exp

import numpy as np

from regkit.interfaces.compiled import SceneArrays
from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Stack, Vector

WEIGHT, REACH = 2, 3
"""Columns of the table, which has a row for each pair of primitives: both, their weight, and the
distance from which on they do not meet. The state has a row more, and begins with their number."""


@compiled
def overlaps(
    centres: Array, covariances: Array, first: Indices, second: Indices, weights: Array
) -> tuple[float, Array, Array]:
    """Returns energy, wrenches (K, 6) and positive semidefinite blocks (K, 6, 6) of overlaps.

    Args:
        centres: Centres of the primitives, (K, 3) [m].
        covariances: Covariances of the primitives, (K, 3, 3) [m^2].
        first: Index of the first primitive of each pair, (M,).
        second: Index of the second primitive of each pair, (M,).
        weights: Weight of each pair, (M,).
    """
    energy = 0.0
    wrenches, blocks = np.zeros((len(centres), 6)), np.zeros((len(centres), 6, 6))
    pulled, direction = np.empty(3), np.empty(6)
    for pair in range(len(first)):
        one, two = first[pair], second[pair]
        a, b = covariances[one], covariances[two]
        x = centres[one, 0] - centres[two, 0]
        y = centres[one, 1] - centres[two, 1]
        z = centres[one, 2] - centres[two, 2]
        d, e, f = a[0, 0] + b[0, 0], a[1, 1] + b[1, 1], a[2, 2] + b[2, 2]
        g, h, i = a[0, 1] + b[0, 1], a[0, 2] + b[0, 2], a[1, 2] + b[1, 2]
        p, q, r = e * f - i * i, h * i - g * f, g * i - e * h
        determinant = d * p + g * q + h * r
        pulled[0] = (p * x + q * y + r * z) / determinant
        pulled[1] = (q * x + (d * f - h * h) * y + (g * h - d * i) * z) / determinant
        pulled[2] = (r * x + (g * h - d * i) * y + (d * e - g * g) * z) / determinant
        overlap = weights[pair] * exp(-0.5 * (x * pulled[0] + y * pulled[1] + z * pulled[2]))
        energy += overlap
        for side in range(2):
            owner = two if side else one
            matrix = b if side else a
            for j in range(3):
                direction[j] = pulled[j] if side else -pulled[j]
            # The axial vector of C u u^T is (C u) x u.
            s = matrix[0, 0] * pulled[0] + matrix[0, 1] * pulled[1] + matrix[0, 2] * pulled[2]
            t = matrix[1, 0] * pulled[0] + matrix[1, 1] * pulled[1] + matrix[1, 2] * pulled[2]
            u = matrix[2, 0] * pulled[0] + matrix[2, 1] * pulled[1] + matrix[2, 2] * pulled[2]
            direction[3] = t * pulled[2] - u * pulled[1]
            direction[4] = u * pulled[0] - s * pulled[2]
            direction[5] = s * pulled[1] - t * pulled[0]
            for j in range(6):
                wrenches[owner, j] += overlap * direction[j]
                for k in range(6):
                    blocks[owner, j, k] += overlap * direction[j] * direction[k]
    return energy, wrenches, blocks


@compiled(python=False)
def bind(scene: SceneArrays, numbers: Vector, table: Matrix, state: Matrix) -> None:
    """Writes the pairs that are near enough to intersect."""
    near = 0
    for row in range(len(table)):
        one, two, square = int(table[row, 0]), int(table[row, 1]), 0.0
        for i in range(3):
            square += (scene.centres[one, i] - scene.centres[two, i]) ** 2
        if square < table[row, REACH] ** 2:
            near += 1
            for column in range(REACH):
                state[near, column] = table[row, column]
    state[0, 0] = near


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
    """Returns the energy of the near pairs, and adds its derivatives."""
    near = int(state[0, 0])
    if near == 0:
        return 0.0
    first, second = np.empty(near, np.int64), np.empty(near, np.int64)
    weights, count = np.empty(near), len(centres)
    for row in range(near):
        first[row], second[row] = int(state[row + 1, 0]), int(state[row + 1, 1])
        weights[row] = state[row + 1, WEIGHT]
    covariances = np.empty((count, 3, 3))
    for k in range(count):
        for i in range(3):
            for j in range(3):
                entry = 0.0
                for a in range(3):
                    entry += axes[k, i, a] * scene.primitives.scales[k, a] ** 2 * axes[k, j, a]
                covariances[k, i, j] = entry
    energy, forces, blocks = overlaps(centres, covariances, first, second, weights)
    if order:
        for k in range(count):
            for i in range(6):
                wrenches[k, i] += forces[k, i]
                for j in range(6):
                    stiffness[k, i, j] += blocks[k, i, j]
    return energy
