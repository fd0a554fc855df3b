"""Distances to tapered capsules in compiled loops."""

from __future__ import annotations

from math import sqrt

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled


@compiled
def cones_of(ends: Array, radii: Array) -> Array:
    """Returns capsules in the form (C, 14) in which distances need no division.

    The columns are the first end (3), the unit axis (3), its length, the tangent of the cone's half
    angle, the first radius, the increase of the radius per unit of length, and the centre (3) and
    radius of a sphere that holds the capsule. The surface is the envelope of spheres whose radius
    decreases along the axis by the sine of that angle.

    Args:
        ends: Centres of the end spheres, (C, 2, 3) [m].
        radii: Radii of the end spheres, (C, 2) [m].
    """
    cones = np.empty((len(ends), 14))
    for index in range(len(ends)):
        square = 0.0
        for i in range(3):
            cones[index, i] = ends[index, 0, i]
            cones[index, 3 + i] = ends[index, 1, i] - ends[index, 0, i]
            cones[index, 10 + i] = 0.5 * (ends[index, 0, i] + ends[index, 1, i])
            square += cones[index, 3 + i] ** 2
        length = sqrt(square)
        safe = length if length > 0.0 else 1.0
        for i in range(3):
            cones[index, 3 + i] /= safe
        # Where the sine is 1, one sphere contains the other; the nearest centre then is the
        # larger sphere's.
        sine = (radii[index, 0] - radii[index, 1]) / safe
        sine = min(max(sine, -1.0 + 1e-12), 1.0 - 1e-12)
        cones[index, 6] = length
        cones[index, 7] = sine / sqrt(1.0 - sine * sine)
        cones[index, 8] = radii[index, 0]
        cones[index, 9] = (radii[index, 1] - radii[index, 0]) / safe
        cones[index, 13] = 0.5 * length + max(radii[index, 0], radii[index, 1])
    return cones


@compiled
def cone_distance(cones: Array, index: int, x: float, y: float, z: float) -> tuple[float, float]:
    """Returns the signed distance [m] of a point to a capsule, and the nearest sphere's height [m].

    For a point at height h along the axis and distance d from it, the nearest sphere has its centre
    at h - d tan(a), clipped to the axis, with the cone's half angle a.

    Args:
        cones: The capsules, (C, 14); see ``cones_of``.
        index: Index of the capsule.
        x: First coordinate of the point [m].
        y: Second coordinate [m].
        z: Third coordinate [m].
    """
    x, y, z = x - cones[index, 0], y - cones[index, 1], z - cones[index, 2]
    u, v, w = cones[index, 3], cones[index, 4], cones[index, 5]
    height = x * u + y * v + z * w
    x, y, z = x - height * u, y - height * v, z - height * w
    square = x * x + y * y + z * z
    nearest = min(max(height - sqrt(square) * cones[index, 7], 0.0), cones[index, 6])
    radius = cones[index, 8] + cones[index, 9] * nearest
    return sqrt(square + (height - nearest) ** 2) - radius, nearest


@compiled
def nearest_capsules(points: Array, ends: Array, radii: Array) -> tuple[Indices, Array, Array]:
    """Returns the nearest capsule of each point, the distance to it, and the sphere's height.

    Args:
        points: Points, (N, 3) [m].
        ends: Centres of the end spheres, (C, 2, 3) [m].
        radii: Radii of the end spheres, (C, 2) [m].

    Returns:
        The indices of the capsules (N,), the signed distances (N,) [m], and the positions (N,) [m]
        of the nearest spheres along the axes.
    """
    cones = cones_of(ends, radii)
    indices = np.empty(len(points), dtype=np.intp)
    distances, heights = np.empty(len(points)), np.empty(len(points))
    last = 0
    for n in range(len(points)):
        x, y, z = points[n, 0], points[n, 1], points[n, 2]
        best, least, at = len(cones), np.inf, 0.0
        # The capsule of the point before is likely the nearest one, and excludes most others.
        for turn in range(-1, len(cones)):
            index = last if turn < 0 else turn
            if index == len(cones) or turn == last:
                continue
            reach = least + cones[index, 13]
            away = (x - cones[index, 10]) ** 2
            away += (y - cones[index, 11]) ** 2 + (z - cones[index, 12]) ** 2
            if reach < 0.0 or away > reach * reach:
                continue
            distance, height = cone_distance(cones, index, x, y, z)
            if distance < least or (distance == least and index < best):
                best, least, at = index, distance, height
        indices[n], distances[n], heights[n] = best, least, at
        last = best
    return indices, distances, heights
