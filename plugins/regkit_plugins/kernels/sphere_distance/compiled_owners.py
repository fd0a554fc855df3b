"""The points of each capsule, in single precision and vector instructions.

``nearest_capsules`` is the readable form. Near a tie either capsule may be chosen. A capsule is a
row of ten numbers: those of ``nearest_capsules``, with the midpoint relative to the data's centre,
and the tangent of the cone's half angle.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from regkit.observation.arrays import ObservationArrays
from regkit.system.compiled import compiled
from regkit.system.machine_types import IntegerVector, SingleMatrix, SingleVector, Vector


class GroupedPoints(NamedTuple):
    """Points in the order of their capsules.

    Attributes:
        places: Coordinates relative to the data's centre, (3, N) [m].
        weights: Weights, (N,).
        numbers: Indices among the data, (N,).
        ends: First point of each capsule, and the end, (K + 1,).
    """

    places: SingleMatrix
    weights: SingleVector
    numbers: IntegerVector
    ends: IntegerVector


@compiled(reordered=True, python=False)
def likely_capsules(
    points: SingleMatrix, capsules: SingleMatrix, handicaps: Vector
) -> IntegerVector:
    """Returns the nearest capsule of each point, (N,).

    Args:
        points: Coordinates of the points relative to the data's centre, (3, N) [m].
        capsules: Capsules, (K, 10).
        handicaps: Summands of the signed squared distances in the comparison, (K,) [m^2].
    """
    count = points.shape[1]
    xs, ys, zs = points[0], points[1], points[2]
    least, owners = np.empty(count, np.float32), np.empty(count, np.int32)
    for j in range(count):
        least[j], owners[j] = np.float32(np.inf), np.int32(0)
    zero = np.float32(0.0)
    for k in range(len(capsules)):
        cx, cy, cz = capsules[k, 0], capsules[k, 1], capsules[k, 2]
        ux, uy, uz = capsules[k, 3], capsules[k, 4], capsules[k, 5]
        half, radius = capsules[k, 6], capsules[k, 7]
        sine, tangent = capsules[k, 8], capsules[k, 9]
        handicap, number = np.float32(handicaps[k]), np.int32(k)
        for j in range(count):
            x, y, z = xs[j] - cx, ys[j] - cy, zs[j] - cz
            along = x * ux + y * uy + z * uz
            across = max(x * x + y * y + z * z - along * along, zero)
            at = min(max(along - np.sqrt(across) * tangent, -half), half)
            beyond = along - at
            distance = np.sqrt(across + beyond * beyond) - radius + sine * at
            cost = distance * abs(distance) + handicap
            nearer = cost < least[j]
            least[j] = cost if nearer else least[j]
            owners[j] = number if nearer else owners[j]
    result = np.empty(count, np.int64)
    for j in range(count):
        result[j] = owners[j]
    return result


@compiled(python=False)
def grouped_points(data: ObservationArrays, owners: IntegerVector, count: int) -> GroupedPoints:
    """Returns the points in the order of their ``count`` capsules."""
    ends, size = np.zeros(count + 1, np.int64), len(owners)
    for j in range(size):
        ends[owners[j] + 1] += 1
    for k in range(count):
        ends[k + 1] += ends[k]
    free = ends.copy()
    places, weights = np.empty((3, size), np.float32), np.empty(size, np.float32)
    numbers = np.empty(size, np.int64)
    for j in range(size):
        at = free[owners[j]]
        free[owners[j]] += 1
        numbers[at], weights[at] = j, data.weights[j]
        for i in range(3):
            places[i, at] = data.centred[i, j]
    return GroupedPoints(places, weights, numbers, ends)
