"""Iterative closest points by Open3D."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from regkit.alignment.rigid_method import Aligned, RigidMethod
from regkit.config.quantities import Iterations, Length
from regkit.system.arrays import Array
from regkit.system.optional import load_library


class Open3DICP(RigidMethod):
    """Iterative closest points by Open3D: point to point, point to plane, or generalized."""

    kind: Literal["open3d_icp"] = "open3d_icp"

    estimation: Literal["point_to_point", "point_to_plane", "generalized"] = "point_to_plane"
    """Distance measure of a pair."""
    distance: Length = 0.1
    """Maximum distance of a pair, as a fraction of the source's size."""
    max_iterations: Iterations = 30
    """Maximum number of iterations; the default is Open3D's."""
    neighbours: Annotated[int, Field(ge=3, le=1000)] = 30
    """Number of neighbours for estimating a normal; the default is Open3D's."""

    def library(self) -> Any:
        """Returns the module ``open3d``."""
        return load_library("open3d")

    def aligned(self, source: Array, target: Array, start: Array, size: float) -> Aligned:
        """Aligns with ``open3d.pipelines.registration``."""
        library = self.library()
        # Open3D prints warnings to standard output, where results belong.
        with library.utility.VerbosityContextManager(library.utility.VerbosityLevel.Error):
            return self._aligned(library, source, target, start, self.distance * size)

    def _aligned(
        self, library: Any, source: Array, target: Array, start: Array, distance: float
    ) -> Aligned:
        clouds = [
            library.geometry.PointCloud(library.utility.Vector3dVector(points))
            for points in (source, target)
        ]
        pipeline = library.pipelines.registration
        criteria = pipeline.ICPConvergenceCriteria(max_iteration=self.max_iterations)
        if self.estimation == "generalized":
            result = pipeline.registration_generalized_icp(
                *clouds,
                distance,
                start,
                pipeline.TransformationEstimationForGeneralizedICP(),
                criteria,
            )
        else:
            if self.estimation == "point_to_plane":
                search = library.geometry.KDTreeSearchParamKNN(self.neighbours)
                clouds[1].estimate_normals(search)
                estimation = pipeline.TransformationEstimationPointToPlane()
            else:
                estimation = pipeline.TransformationEstimationPointToPoint()
            result = pipeline.registration_icp(*clouds, distance, start, estimation, criteria)
        near = len(result.correspondence_set)
        message = f"{near} pairs within {distance:.3g}"
        return Aligned(np.asarray(result.transformation), near > 0, 0, message)
