"""Mean distances of points to many configurations of a limb, in compiled loops."""

from __future__ import annotations

from math import sqrt

import numpy as np

from regkit.system.arrays import Array
from regkit.system.compiled import compiled


@compiled
def mean_gaps(places: Array, radii: Array, points: Array, reach: float) -> Array:
    """Returns the mean distance (N,) of points to the spheres' surface, in units of ``reach``.

    Args:
        places: Centres of the spheres in N configurations, (N, P, 3) [m].
        radii: Radii of the spheres, (P,) [m].
        points: Points, (M, 3) [m].
        reach: Upper bound of each distance [m].
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
