"""Evenly spread points inside tapered capsules."""

from __future__ import annotations

import numpy as np

from regkit.geometry.capsules import Capsules
from regkit.system.arrays import Array

FEWEST = 4
"""Least number of grid points across a capsule."""


def points_inside(capsules: Capsules, spacing: float) -> Array:
    """Returns points about ``spacing`` [m] apart inside the union of capsules (C), (N, 3) [m].

    Each capsule is filled by a grid along its own axis, so that a thin one has points too; where
    capsules overlap, the points are those of the first. The result is the same in each call.

    Args:
        capsules: Capsules of one frame.
        spacing: Distance of neighbouring points, which may be less across a thin capsule [m].
    """
    found = []
    for index, axes in enumerate(capsules.frames()):
        points = _grid(capsules.ends[index], capsules.radii[index], axes, spacing)
        points = points[_one(capsules, slice(index, index + 1)).surface_distance(points) < 0.0]
        if index:
            points = points[_one(capsules, slice(index)).surface_distance(points) >= 0.0]
        found.append(points)
    return np.concatenate(found)


def capsule_points(ends: Array, radii: Array, count: int) -> Array:
    """Returns about ``count`` points inside one capsule, (N, 3) [m].

    Args:
        ends: Centres of its two spheres, (2, 3) [m].
        radii: Their radii, (2,) [m].
        count: Number of points.
    """
    capsule = Capsules(np.zeros(1, dtype=np.intp), ends[None], radii[None])
    return points_inside(capsule, spacing_of(capsule, count))


def spacing_of(capsules: Capsules, count: int) -> float:
    """Returns the spacing [m] at which ``count`` points fill capsules that do not overlap."""
    return float(np.cbrt(_volumes(capsules).sum() / count))


def _grid(ends: Array, radii: Array, axes: Array, spacing: float) -> Array:
    """Returns a grid (N, 3) [m] about a capsule, whose axis is the second of its axes (3, 3)."""
    length = float(np.linalg.norm(ends[1] - ends[0]))
    low, high = min(-radii[0], length - radii[1]), max(length + radii[1], radii[0])
    across = _middles(-radii.max(), radii.max(), spacing)
    grid = np.meshgrid(across, _middles(low, high, spacing), across, indexing="ij")
    return np.asarray(ends[0] + np.stack(grid, axis=-1).reshape(-1, 3) @ axes.T)


def _middles(low: float, high: float, spacing: float) -> Array:
    """Returns the middles (K,) of parts of an interval about ``spacing`` wide [m]."""
    count = max(FEWEST, int(np.rint((high - low) / spacing)))
    return np.asarray(low + (np.arange(count) + 0.5) * (high - low) / count)


def _volumes(capsules: Capsules) -> Array:
    """Returns about the volumes of capsules, (C,) [m^3]."""
    lengths = np.linalg.norm(capsules.ends[:, 1] - capsules.ends[:, 0], axis=1)
    first, second = capsules.radii.T
    cones = lengths * (first**2 + first * second + second**2) / 3.0
    larger = 4.0 / 3.0 * capsules.radii.max(axis=1) ** 3  # It may contain the other sphere.
    return np.asarray(np.pi * np.maximum(cones + 2.0 / 3.0 * (first**3 + second**3), larger))


def _one(capsules: Capsules, chosen: slice) -> Capsules:
    return Capsules(capsules.segments[chosen], capsules.ends[chosen], capsules.radii[chosen])
