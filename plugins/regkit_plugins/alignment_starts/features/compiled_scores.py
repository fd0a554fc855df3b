"""How well a motion brings two clouds together, and how much contradicts it, in compiled loops."""

from __future__ import annotations

from math import floor

import numpy as np

from regkit.system.arrays import Array
from regkit.system.compiled import compiled
from regkit_plugins.alignment_starts.features.compiled_surroundings import Surroundings

LEAST_COSINE = 0.5
"""Cosine between normals below which points do not lie on one surface."""

FRONT = 3.0
"""Distance in front of a view's surface beyond which a point contradicts it, in cells."""

OUTSIDE = 0.5
"""Weight of a point beside the silhouette of a view, where the sensor may have missed something; a
point in front of its surface weighs 1."""


@compiled
def scores(
    motions: Array,
    source: Surroundings,
    target: Surroundings,
    some: tuple[Array, Array, Array, Array],
    within: float,
) -> Array:
    """Returns overlap and contradictions of motions, as fractions of both clouds' points, (T, 2).

    Args:
        motions: Motions from the source to the target, (T, 3, 4).
        source: The source.
        target: The target.
        some: Points and normals of the source and of the target by which they are judged.
        within: Distance from a surface within which a point lies on it [m].
    """
    found, back = np.empty((len(motions), 2)), np.empty((3, 4))
    for m in range(len(motions)):
        motion = motions[m]
        for i in range(3):
            back[i, 3] = 0.0
            for j in range(3):
                back[i, j] = motion[j, i]
                back[i, 3] -= motion[j, i] * motion[j, 3]
        first, against = _share(motion, some[0], some[1], target, within)
        second, against_too = _share(back, some[2], some[3], source, within)
        found[m, 0], found[m, 1] = 0.5 * (first + second), 0.5 * (against + against_too)
    return found


@compiled(reordered=True)
def _share(
    motion: Array, points: Array, normals: Array, other: Surroundings, within: float
) -> tuple[float, float]:
    """Returns the fractions of moved points that lie on another cloud, and that contradict it."""
    on, against = 0.0, 0.0
    for n in range(len(points)):
        a, b, c = points[n, 0], points[n, 1], points[n, 2]
        x = motion[0, 0] * a + motion[0, 1] * b + motion[0, 2] * c + motion[0, 3]
        y = motion[1, 0] * a + motion[1, 1] * b + motion[1, 2] * c + motion[1, 3]
        z = motion[2, 0] * a + motion[2, 1] * b + motion[2, 2] * c + motion[2, 3]
        weight, index = 0.0, nearest_to(other, x, y, z)
        if index >= 0:
            u, v = x - other.points[index, 0], y - other.points[index, 1]
            w = z - other.points[index, 2]
            p, q, r = other.normals[index, 0], other.normals[index, 1], other.normals[index, 2]
            if u * u + v * v + w * w < within * within:
                a, b, c = normals[n, 0], normals[n, 1], normals[n, 2]
                cosine = p * (motion[0, 0] * a + motion[0, 1] * b + motion[0, 2] * c)
                cosine += q * (motion[1, 0] * a + motion[1, 1] * b + motion[1, 2] * c)
                cosine += r * (motion[2, 0] * a + motion[2, 1] * b + motion[2, 2] * c)
                off = 2.0 * (u * p + v * q + w * r) / within
                if cosine > LEAST_COSINE and off * off < 1.0:
                    weight = (cosine - LEAST_COSINE) / (1.0 - LEAST_COSINE) * (1.0 - off * off)
        on += weight
        if weight == 0.0 and other.seen:
            against += _contradiction(other, x, y, z)
    return on / len(points), against / len(points)


@compiled
def nearest_to(cloud: Surroundings, x: float, y: float, z: float) -> int:
    """Returns the index of about the nearest point to a place [m]; -1 if none is near."""
    i = floor((x - cloud.low[0]) / cloud.size)
    j = floor((y - cloud.low[1]) / cloud.size)
    k = floor((z - cloud.low[2]) / cloud.size)
    width, height, depth = cloud.nearest.shape
    if i < 0 or j < 0 or k < 0 or i >= width or j >= height or k >= depth:
        return -1
    index: int = cloud.nearest[i, j, k]
    return index


@compiled
def _contradiction(cloud: Surroundings, x: float, y: float, z: float) -> float:
    """Returns the weight with which a view contradicts a point at a place [m]: space is free."""
    axes = cloud.axes
    across = axes[0, 0] * x + axes[0, 1] * y + axes[0, 2] * z - cloud.corner[0]
    along = axes[1, 0] * x + axes[1, 1] * y + axes[1, 2] * z - cloud.corner[1]
    i, j = floor(across / cloud.pixel), floor(along / cloud.pixel)
    width, height = cloud.front.shape
    if i < 0 or j < 0 or i >= width or j >= height or cloud.front[i, j] == -np.inf:
        return OUTSIDE
    ahead = axes[2, 0] * x + axes[2, 1] * y + axes[2, 2] * z - cloud.front[i, j]
    return 1.0 if ahead > FRONT * cloud.size else 0.0
