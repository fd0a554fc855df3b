"""Registration quality of two clouds: fitness, inlier RMSE and overlap."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.clouds.tree import Tree
from regkit.geometry.rigid import inverse, transformed
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


@dataclass(frozen=True)
class Agreements:
    """Two clouds, to evaluate many transforms.

    Attributes:
        source: The source.
        target: The target.
    """

    source: Tree
    target: Tree

    @classmethod
    def of(cls, source: Array, target: Array) -> Agreements:
        """Returns the two clouds (N, 3) and (M, 3) [m]."""
        return cls(Tree.of(source), Tree.of(target))

    def after(self, transform: Array, distance: float) -> Agreement:
        """Evaluates T_target_source (4, 4), with correspondences closer than a distance [m]."""
        aligned = transformed(transform, self.source.points)
        back = transformed(inverse(transform), self.target.points)
        to_target = self.target.nearest(aligned, 1, distance)[0]
        to_source = self.source.nearest(back, 1, distance)[0]
        inliers = to_target[np.isfinite(to_target)]
        return Agreement(
            distance=distance,
            fitness=len(inliers) / len(aligned),
            inlier_rmse=float(np.sqrt((inliers**2).mean())) if len(inliers) else float("nan"),
            overlap=float(np.isfinite(to_source).mean()),
        )


def agreement(source: Array, target: Array, transform: Array, distance: float) -> Agreement:
    """Evaluates the registration of a source to a target.

    Args:
        source: Source points, (N, 3) [m].
        target: Target points, (M, 3) [m].
        transform: T_target_source, (4, 4).
        distance: Maximum correspondence distance [m].
    """
    return Agreements.of(source, target).after(transform, distance)
