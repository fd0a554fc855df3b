"""The nearest capsule of each point, in single precision and vector instructions.

``nearest_capsules`` is the readable form. Near a tie either capsule may be returned.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from regkit.system.compiled import compiled
from regkit.system.machine_types import IntegerVector, Matrix, SingleMatrix, Vector


@compiled(reordered=True, python=False)
def likely_capsules(
    points: SingleMatrix, centre: Vector, capsules: Matrix, handicaps: Vector
) -> IntegerVector:
    """Returns the nearest capsule of each point, (N,).

    Args:
        points: Coordinates of the points relative to the centre, (3, N) [m].
        centre: The centre, (3,) [m].
        capsules: Capsules, (K, 9).
        handicaps: Summands of the signed squared distances in the comparison, (K,) [m^2].
    """
    count = points.shape[1]
    xs, ys, zs = points[0], points[1], points[2]
    least, owners = np.empty(count, np.float32), np.empty(count, np.int32)
    for j in range(count):
        least[j], owners[j] = np.float32(np.inf), np.int32(0)
    zero = np.float32(0.0)
    for k in range(len(capsules)):
        cx = np.float32(capsules[k, 0] - centre[0])
        cy = np.float32(capsules[k, 1] - centre[1])
        cz = np.float32(capsules[k, 2] - centre[2])
        ux, uy = np.float32(capsules[k, 3]), np.float32(capsules[k, 4])
        uz, half = np.float32(capsules[k, 5]), np.float32(capsules[k, 6])
        radius, sine = np.float32(capsules[k, 7]), np.float32(capsules[k, 8])
        tangent = np.float32(capsules[k, 8] / sqrt(1.0 - capsules[k, 8] ** 2))
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
def capsule_distances(
    points: Matrix, capsules: Matrix, owners: IntegerVector
) -> tuple[Vector, Vector]:
    """Returns each point's signed distance (N,) and axis position (N,) [m] on its capsule."""
    distances, places = np.empty(len(points)), np.empty(len(points))
    for i in range(len(points)):
        k = owners[i]
        x = points[i, 0] - capsules[k, 0]
        y = points[i, 1] - capsules[k, 1]
        z = points[i, 2] - capsules[k, 2]
        along = x * capsules[k, 3] + y * capsules[k, 4] + z * capsules[k, 5]
        side = sqrt(max(x * x + y * y + z * z - along * along, 0.0))
        sine, half = capsules[k, 8], capsules[k, 6]
        at = min(max(along - side * sine / sqrt(1.0 - sine**2), -half), half)
        places[i] = at
        distances[i] = sqrt(side * side + (along - at) ** 2) - capsules[k, 7] + sine * at
    return distances, places
