"""Points and weights of an observation in single precision, in a compiled loop."""

from __future__ import annotations

import numpy as np

from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, SingleMatrix, SingleVector, Vector


@compiled
def centred_points(
    points: Matrix, weights: Vector, variances: Vector
) -> tuple[SingleMatrix, SingleVector, Vector, bool]:
    """Returns what ``ObservationArrays`` holds of points.

    Args:
        points: (N, 3) [m].
        weights: Weights of the points, (N,).
        variances: Variances of the points, (N,) [m^2].

    Returns:
        Coordinates relative to the mean, (3, N) [m]; weights that sum to one, (N,); the mean, (3,)
        [m]; and whether all variances are the same.
    """
    count, total, alike = len(points), 0.0, True
    centre = np.zeros(3)
    for n in range(count):
        total += weights[n]
        alike = alike and variances[n] == variances[0]
        for axis in range(3):
            centre[axis] += points[n, axis]
    for axis in range(3):
        centre[axis] /= count
    centred, shares = np.empty((3, count), np.float32), np.empty(count, np.float32)
    for n in range(count):
        shares[n] = weights[n] / total
        for axis in range(3):
            centred[axis, n] = points[n, axis] - centre[axis]
    return centred, shares, centre, alike
