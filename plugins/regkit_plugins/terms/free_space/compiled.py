"""The free-space term, compiled; ``BoundFreeSpace`` is its readable form."""

from __future__ import annotations

from math import sqrt

import numpy as np

from regkit.interfaces.compiled import SceneArrays
from regkit.observation.free_space import free_space_distances
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Stack, Vector

OWNER, OFFSET, WIDTH, MARGIN, WEIGHT = 0, 1, 4, 5, 6
"""Columns of the table, which has a row for each sample."""


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
    """Returns the energy of the samples in free space, and adds its derivatives."""
    image, count = scene.data.silhouette, len(table)
    if not image.known:
        return 0.0
    points, arms, margins = np.empty((count, 3)), np.empty((count, 3)), np.empty(count)
    for sample in range(count):
        k = int(table[sample, OWNER])
        margins[sample] = table[sample, MARGIN]
        for i in range(3):
            arm = 0.0
            for j in range(3):
                arm += axes[k, i, j] * table[sample, OFFSET + j]
            arms[sample, i] = arm
            points[sample, i] = centres[k, i] + arm
    distances, slopes = free_space_distances(
        points, margins, image.nearest, image.shown, image.scale, image.offset, image.half
    )
    energy, row = 0.0, np.empty(6)
    for sample in range(count):
        if distances[sample] == 0.0:
            continue
        k, width, weight = int(table[sample, OWNER]), table[sample, WIDTH], table[sample, WEIGHT]
        ratio = distances[sample] / width
        root = sqrt(1.0 + ratio * ratio)
        energy += weight * (root - 1.0)
        if order == 0:
            continue
        for i in range(3):
            j, m = (i + 1) % 3, (i + 2) % 3
            row[i] = slopes[sample, i] / width
            turn = arms[sample, j] * slopes[sample, m] - arms[sample, m] * slopes[sample, j]
            row[3 + i] = turn / width
        for i in range(6):
            scaled = weight / root * row[i]
            wrenches[k, i] += scaled * ratio
            for j in range(6):
                stiffness[k, i, j] += scaled * row[j]
    return energy
