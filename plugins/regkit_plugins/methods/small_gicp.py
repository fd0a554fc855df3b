"""Generalized iterative closest points by small_gicp."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from regkit.alignment.rigid_method import Aligned, RigidMethod
from regkit.config.quantities import Iterations, Length
from regkit.system.arrays import Array
from regkit.system.optional import load_library


class SmallGICP(RigidMethod):
    """Registration by small_gicp on one thread, without further downsampling of the clouds."""

    kind: Literal["small_gicp"] = "small_gicp"

    registration_type: Literal["ICP", "PLANE_ICP", "GICP"] = "GICP"
    """Distance measure of a pair."""
    distance: Length = 0.1
    """Maximum distance of a pair, as a fraction of the source's size."""
    neighbours: Annotated[int, Field(ge=3, le=1000)] = 20
    """Number of neighbours for estimating a covariance; the default is the library's."""
    max_iterations: Iterations = 20
    """Maximum number of iterations; the default is the library's."""
    translation_tolerance: Annotated[float, Field(gt=0.0, le=10.0)] = 1e-4
    """The iteration stops at a step below this fraction of the source's size and a rotation below
    0.1 degrees."""

    def library(self) -> Any:
        """Returns the module ``small_gicp``."""
        return load_library("small_gicp", install="pip install 'regkit[baselines]'")

    def aligned(self, source: Array, target: Array, start: Array, size: float) -> Aligned:
        """Aligns with ``small_gicp.align``."""
        gicp = self.library()
        clouds = [gicp.PointCloud(points) for points in (target, source)]
        trees = [gicp.KdTree(cloud) for cloud in clouds]
        for cloud, tree in zip(clouds, trees, strict=True):
            gicp.estimate_normals_covariances(cloud, tree, self.neighbours)
        result = gicp.align(
            *clouds,
            trees[0],
            init_T_target_source=start,
            registration_type=self.registration_type,
            max_correspondence_distance=self.distance * size,
            max_iterations=self.max_iterations,
            translation_epsilon=self.translation_tolerance * size,
        )
        message = f"{result.num_inliers} pairs within {self.distance * size:.3g}"
        return Aligned(
            np.asarray(result.T_target_source), result.converged, result.iterations, message
        )
