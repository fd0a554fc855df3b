"""Registration quality of two clouds: fitness, inlier RMSE and overlap."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.geometry.rigid import transformed
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Agreement:
    """Registration quality of a source aligned to a target; see Open3D's ``RegistrationResult``.

    Attributes:
        distance: Maximum correspondence distance [m].
        fitness: Fraction of source points with a correspondence in the target.
        inlier_rmse: Root mean square distance of these correspondences [m]; NaN without any.
        overlap: Fraction of target points with a correspondence in the source.
    """

    distance: float
    fitness: float
    inlier_rmse: float
    overlap: float


def agreement(source: Array, target: Array, transform: Array, distance: float) -> Agreement:
    """Evaluates the registration of a source to a target.

    Args:
        source: Source points, (N, 3) [m].
        target: Target points, (M, 3) [m].
        transform: T_target_source, (4, 4).
        distance: Maximum correspondence distance [m].
    """
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
