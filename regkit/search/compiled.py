"""Gaps between many configurations of a limb and points, in compiled loops."""

from __future__ import annotations

from math import sqrt

import numpy as np

from regkit.system.arrays import Array
from regkit.system.compiled import compiled


@compiled
def mean_gaps(places: Array, radii: Array, points: Array, reach: float) -> Array:
    """How far points are from the surface of spheres in each of N places, on average, (N,).

    Args:
        places: Centres of the spheres, (N, P, 3) [m].
        radii: (P,) [m].
        points: (M, 3) [m].
        reach: No gap counts more than this [m]; the mean is a part of it.
    """
    means = np.empty(len(places))
    for index in range(len(places)):
        total = 0.0
        for point in range(len(points)):
            least = reach
            for sphere in range(len(radii)):
                x = places[index, sphere, 0] - points[point, 0]
                y = places[index, sphere, 1] - points[point, 1]
                z = places[index, sphere, 2] - points[point, 2]
                least = min(least, abs(sqrt(x * x + y * y + z * z) - radii[sphere]))
            total += least
        means[index] = total / (reach * len(points))
    return means
