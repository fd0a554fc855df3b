"""Comparison of many configurations of a limb with points, in compiled loops."""

from __future__ import annotations

import numpy as np

from regkit.geometry.compiled_capsules import cone_distance, cones_of
from regkit.system.arrays import Array, Indices, Singles
from regkit.system.compiled import compiled


@compiled
def mean_gaps(places: Singles, radii: Singles, points: Singles, most: np.float32) -> Array:
    """Returns the mean distance (N,) of points to the spheres' surface, in units of ``most``.

    Square roots take most of the time, and several times less of it in single precision, whose
    rounding is a ten thousandth of a millimetre.

    Args:
        places: Centres of the spheres in N configurations, (P, 3, N) [m].
        radii: Radii of the spheres, (P,) [m].
        points: Points, (M, 3) [m].
        most: Upper bound of each distance [m].
    """
    count = places.shape[2]
    means, least = np.empty(count), np.empty(count, dtype=np.float32)
    for n in range(count):
        means[n] = 0.0
    for point in range(len(points)):
        a, b, c = points[point, 0], points[point, 1], points[point, 2]
        for n in range(count):
            least[n] = most
        for sphere in range(len(radii)):
            radius = radii[sphere]
            for n in range(count):
                x, y, z = (
                    places[sphere, 0, n] - a,
                    places[sphere, 1, n] - b,
                    places[sphere, 2, n] - c,
                )
                gap = abs(np.sqrt(x * x + y * y + z * z) - radius)
                least[n] = gap if gap < least[n] else least[n]
        for n in range(count):
            means[n] += least[n]
    for n in range(count):
        means[n] /= most * len(points)
    return means


@compiled
def unexplained(
    points: Array, centre: Array, radius: float, ends: Array, radii: Array, margin: float
) -> Indices:
    """Returns the indices (K,) of the points in a ball that are not on any of some capsules.

    Args:
        points: Points, (N, 3) [m].
        centre: Centre of the ball, (3,) [m].
        radius: Its radius [m].
        ends: Centres of the capsules' end spheres, (C, 2, 3) [m].
        radii: Radii of the capsules' end spheres, (C, 2) [m].
        margin: Distance from a capsule within which a point is on it [m].
    """
    cones = cones_of(ends, radii)
    chosen = np.empty(len(points), dtype=np.intp)
    count = 0
    for n in range(len(points)):
        x, y, z = points[n, 0], points[n, 1], points[n, 2]
        square = (x - centre[0]) ** 2 + (y - centre[1]) ** 2 + (z - centre[2]) ** 2
        if square >= radius * radius:
            continue
        explained = False
        for index in range(len(cones)):
            away = (x - cones[index, 10]) ** 2
            away += (y - cones[index, 11]) ** 2 + (z - cones[index, 12]) ** 2
            if away > (margin + cones[index, 13]) ** 2:
                continue
            if cone_distance(cones, index, x, y, z)[0] <= margin:
                explained = True
                break
        if not explained:
            chosen[count] = n
            count += 1
    return chosen[:count]
