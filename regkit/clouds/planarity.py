"""Planarity: how much of a cloud lies on a few planes, as furniture does and bodies do not."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array

POINTS = 300
"""Number of points that are looked at."""

TRIALS = 300
"""Number of triples of points through which planes are tried."""

FEWEST = 10
"""Fewer points than this are on any plane."""


def planar_share(points: Array, tolerance: float, planes: int = 2) -> float:
    """Returns the fraction of points (N, 3) [m] on the largest planes, one after the other.

    Planes through random triples of points are tried, always the same ones (RANSAC; Fischler and
    Bolles, Random sample consensus, 1981).

    Args:
        points: The cloud, (N, 3) [m].
        tolerance: Distance within which a point lies on a plane [m].
        planes: Number of planes.
    """
    random = np.random.default_rng(0)
    rest = points[:: max(1, len(points) // POINTS)]
    count, found = len(rest), 0
    for _ in range(planes):
        if len(rest) < FEWEST:
            break
        a, b, c = np.moveaxis(rest[random.integers(len(rest), size=(TRIALS, 3))], 1, 0)
        normals = np.cross(b - a, c - a)
        lengths = np.linalg.norm(normals, axis=1)
        # Three points on a line show no plane.
        distinct = lengths > 1e-3 * tolerance**2
        if not distinct.any():
            break
        normals = normals[distinct] / lengths[distinct, None]
        offsets = (normals * a[distinct]).sum(axis=1)
        on = np.abs(normals @ rest.T - offsets[:, None]) < tolerance
        best = int(on.sum(axis=1).argmax())
        found += int(on[best].sum())
        rest = rest[~on[best]]
    return found / count if count else 0.0
