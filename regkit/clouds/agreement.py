"""How well an aligned cloud lies on another."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.geometry.rigid import transformed
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Agreement:
    """How well a source lies on a target.

    Attributes:
        distance: What is farther away than this does not agree [m].
        fitness: Share of the source's points that have a target point within the distance.
        inlier_rmse: Root mean square distance of these to it [m]; NaN if there is none.
        overlap: Share of the target's points that have a source point within the distance.
    """

    distance: float
    fitness: float
    inlier_rmse: float
    overlap: float


def agreement(source: Array, target: Array, transform: Array, distance: float) -> Agreement:
    """How well a source (N, 3) lies on a target (M, 3) after T_target_source (4, 4)."""
    from scipy.spatial import KDTree

    aligned = transformed(transform, source)
    to_target, _ = KDTree(target).query(aligned, distance_upper_bound=distance)
    to_source, _ = KDTree(aligned).query(target, distance_upper_bound=distance)
    found = np.asarray(to_target)
    inliers = found[np.isfinite(found)]
    return Agreement(
        distance=distance,
        fitness=len(inliers) / len(source),
        inlier_rmse=float(np.sqrt((inliers**2).mean())) if len(inliers) else float("nan"),
        overlap=float(np.isfinite(to_source).mean()),
    )
