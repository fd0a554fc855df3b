"""Signed distances of points to tapered capsules, and their derivatives, in compiled loops.

``BoundSphereDistance`` documents the formulas. A capsule is a row of nine numbers: the midpoint of
the axis (3), the unit vector along it (3), half its length, the radius at the midpoint, and the
sine of the cone's half angle, positive if the radius falls along the axis. Lengths are in metres.
"""

from __future__ import annotations

from math import inf, sqrt

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled


@compiled
def nearest_capsules(
    points: Array, capsules: Array, handicaps: Array
) -> tuple[Indices, Array, Array]:
    """Returns each point's nearest capsule (N,), signed distance (N,) and axis position (N,).

    The axis position is that of the nearest sphere's centre, from the midpoint [m].

    Args:
        points: Data points, (N, 3) [m].
        capsules: Capsules, (K, 9).
        handicaps: Summands of the signed squared distances in the comparison, (K,) [m^2].
    """
    count = len(points)
    owners = np.zeros(count, dtype=np.intp)
    distances, places = np.empty(count), np.empty(count)
    own = np.empty((5, len(capsules)))
    halves, radii, sines, bounds, tangents = own[0], own[1], own[2], own[3], own[4]
    for k in range(len(capsules)):
        halves[k], radii[k], sines[k] = capsules[k, 6], capsules[k, 7], capsules[k, 8]
        bounds[k] = radii[k] + (1.0 + abs(sines[k])) * halves[k]
        tangents[k] = sines[k] / sqrt(1.0 - sines[k] * sines[k])
    likely = 0
    for i in range(count):
        px, py, pz = points[i, 0], points[i, 1], points[i, 2]
        least, reach = inf, inf
        # The previous point's capsule comes first, because it is often the nearest again.
        for candidate in range(-1, len(capsules)):
            k = likely if candidate < 0 else candidate
            x, y, z = px - capsules[k, 0], py - capsules[k, 1], pz - capsules[k, 2]
            square = x * x + y * y + z * z
            # The bounding sphere excludes capsules that cannot cost less than the best so far.
            far = reach + bounds[k]
            if far < 0.0 or square > far * far:
                continue
            along = x * capsules[k, 3] + y * capsules[k, 4] + z * capsules[k, 5]
            side = sqrt(max(square - along * along, 0.0))
            at = min(max(along - side * tangents[k], -halves[k]), halves[k])
            distance = sqrt(side * side + (along - at) ** 2) - radii[k] + sines[k] * at
            cost = distance * abs(distance) + handicaps[k]
            if cost < least:
                least = cost
                reach = sqrt(cost) if cost > 0.0 else -sqrt(-cost)
                owners[i], distances[i], places[i] = k, distance, at
        likely = owners[i]
    return owners, distances, places


@compiled
def residuals_and_rows(
    points: Array,
    capsules: Array,
    owners: Indices,
    distances: Array,
    places: Array,
    front: bool,
    rows: Array,
) -> Array:
    """Returns residuals (N,) [m], and writes their derivatives to the owners' motions.

    Args:
        points: Data points, (N, 3) [m].
        capsules: Capsules, (K, 9).
        owners: Nearest capsule of each point, (N,).
        distances: Its signed distance, (N,) [m].
        places: Axis position of the nearest sphere's centre, (N,) [m].
        front: Whether points behind the outline are compared with the front of their capsule.
        rows: Written, (N, 6); without any, (0, 6), only the residuals are computed.
    """
    residuals = np.empty(len(points))
    arm, gap, ray, slope = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    for i in range(len(points)):
        residuals[i] = distances[i]
        k, at = owners[i], places[i]
        half, sine = capsules[k, 6], capsules[k, 8]
        length = sqrt(points[i, 0] ** 2 + points[i, 1] ** 2 + points[i, 2] ** 2)
        square, behind, along = 0.0, 0.0, 0.0
        for j in range(3):
            arm[j] = points[i, j] - capsules[k, j]
            gap[j] = arm[j] - at * capsules[k, 3 + j]
            ray[j] = points[i, j] / length if front else 0.0
            square += gap[j] ** 2
            behind += gap[j] * ray[j]
            along += arm[j] * capsules[k, 3 + j]
        norm = sqrt(square)
        if norm == 0.0:
            # At the centre of a sphere no direction is nearest.
            for j in range(6 if len(rows) else 0):
                rows[i, j] = 0.0
            continue
        turning = 0.0
        for j in range(3):
            slope[j] = gap[j] / norm
        if behind > 0.0:
            radius = norm - distances[i]
            lateral = sqrt(max(square - behind**2, 0.0))
            beside = lateral - radius
            residual = sqrt(behind**2 + beside**2)
            residuals[i] = residual
            if not len(rows):
                continue
            down = 0.0
            for j in range(3):
                slope[j] = behind * ray[j] / residual
                if lateral > 0.0:
                    slope[j] += beside * (gap[j] - behind * ray[j]) / (lateral * residual)
                down += slope[j] * capsules[k, 3 + j]
            if lateral > 0.0:
                turning = behind * radius / (lateral * residual)
            if abs(at) < half:
                # The nearest sphere moves along the axis with the point.
                change = beside * sine / residual - down
                length = arm[0] ** 2 + arm[1] ** 2 + arm[2] ** 2
                side = sqrt(max(length - along**2, 0.0))
                tilt = sine / sqrt(1.0 - sine**2) / side if side > 0.0 else 0.0
                for j in range(3):
                    unit = capsules[k, 3 + j]
                    slope[j] += change * (unit - tilt * (arm[j] - along * unit))
        for j in range(3 if len(rows) else 0):
            a, b = (j + 1) % 3, (j + 2) % 3
            rows[i, j] = -slope[j]
            rows[i, 3 + j] = arm[b] * slope[a] - arm[a] * slope[b]
            rows[i, 3 + j] += turning * (ray[b] * gap[a] - ray[a] * gap[b])
    return residuals
