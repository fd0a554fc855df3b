"""Search for the planes that bound a scene."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import scipy
from numpy.typing import NDArray

from regkit.clouds import voxel_downsampled
from regkit.system.arrays import Array
from regkit_plugins.segmenters.planes.plane import DEVIATIONS, NOISE, Plane

VOXEL = 0.03
"""Spacing of the searched points, in sizes of the body, so that near surfaces do not count more."""

MOST_POINTS = 4000
"""This many points show the planes as well as all of them."""

TRIALS = 400
"""Number of planes tried per round, each through three points of a neighbourhood."""

NEIGHBOURS = 40
"""Number of points in a neighbourhood."""

ROUNDS = 12
"""Number of planes that are examined: some are surfaces of furniture and are left."""

BEYOND = 0.05
"""Largest share of the points behind a plane that bounds the scene."""

NARROWEST = 0.35
"""Least extent of a plane across its longest axis, in sizes of the body: a trunk is narrower."""

PERCENTILES = (5.0, 95.0)
"""Percentiles between which a plane's extent is measured, without stray points."""


def bounding_planes(points: Array, size: float, least: float, most: int) -> Iterator[Plane]:
    """Yields the large planes that have hardly any point behind them: floor, walls and ceiling.

    Candidates come from three neighbouring points (RANSAC: Fischler and Bolles, 1981). The table
    that hides the legs is no such plane, since there is something below it, and neither is a flat
    trunk, with the room behind.

    Args:
        points: Points in the camera frame, (N, 3) [m].
        size: Size of the body [m].
        least: Least area of a plane, in squares of the body's size.
        most: Largest number of planes.
    """
    random = np.random.default_rng(0)
    points = voxel_downsampled(points, VOXEL * size)
    each = (VOXEL * size) ** 2
    if len(points) > MOST_POINTS:
        each *= len(points) / MOST_POINTS
        points = points[random.choice(len(points), MOST_POINTS, replace=False)]
    margin, found, rest = 0.5 * VOXEL * size, 0, points
    for _ in range(ROUNDS):
        if found == most or len(rest) < NEIGHBOURS:
            return
        plane = _largest(rest, margin, random)
        if plane is None:
            return
        inside = plane.holds(rest)
        large = inside.sum() * each >= least * size**2
        if large and _is_wide(rest[inside], NARROWEST * size) and _bounds(plane, points):
            found += 1
            yield plane
        rest = rest[~inside]


def _largest(points: Array, margin: float, random: np.random.Generator) -> Plane | None:
    """Returns the plane with the most points (N, 3), or None if all candidates are degenerate."""
    seeds = random.choice(len(points), TRIALS)
    around = np.asarray(scipy.spatial.KDTree(points).query(points[seeds], k=NEIGHBOURS)[1])
    chosen = random.integers(1, NEIGHBOURS, (2, TRIALS))
    first, second = (points[around[np.arange(TRIALS), one]] - points[seeds] for one in chosen)
    normals = np.cross(first, second)
    lengths = np.linalg.norm(normals, axis=1)
    sound = lengths > 0.05 * np.linalg.norm(first, axis=1) * np.linalg.norm(second, axis=1)
    if not sound.any():
        return None
    normals = normals[sound] / lengths[sound, None]
    offsets = -(normals * points[seeds[sound]]).sum(axis=1)
    allowed = np.maximum(margin, DEVIATIONS * NOISE * points[:, 2] ** 2)
    counts = (np.abs(points @ normals.T + offsets) < allowed[:, None]).sum(axis=0)
    best = int(counts.argmax())
    plane = Plane(normals[best], float(offsets[best]), margin, NOISE)
    for _ in range(3):
        heights = plane.heights(points)
        inside = np.abs(heights) < allowed
        if inside.sum() < 3:
            return None
        plane = _fitted(points[inside], margin, 1.0 / allowed[inside] ** 2)
    return plane


def _fitted(points: Array, margin: float, weights: Array) -> Plane:
    """Returns the plane that fits weighted points best, with their noise."""
    centre = np.average(points, axis=0, weights=weights)
    centred = points - centre
    normal = np.linalg.eigh((weights[:, None] * centred).T @ centred)[1][:, 0]
    offset = -float(normal @ centre)
    if offset < 0.0:
        normal, offset = -normal, -offset
    heights = np.abs(points @ normal + offset)
    noise = 1.4826 * float(np.median(heights / np.maximum(points[:, 2], 1e-3) ** 2))
    return Plane(normal, offset, margin, min(noise, NOISE))


def _is_wide(points: Array, least: float) -> bool:
    """Returns whether points (N, 3) of a plane extend over ``least`` [m] along both of its axes."""
    if len(points) < 3:
        return False
    centred = points - points.mean(axis=0)
    axes = np.linalg.eigh(centred.T @ centred)[1]
    low, high = np.percentile(centred @ axes[:, 1:], PERCENTILES, axis=0)
    return bool(((high - low) >= least).all())


def _bounds(plane: Plane, points: NDArray[np.float64]) -> bool:
    """Returns whether hardly any of the points (N, 3) is behind a plane."""
    half = plane.thickness(points)
    return bool((plane.heights(points) < -2.0 * half).mean() <= BEYOND)
