"""Matched features by Open3D."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from regkit.clouds import spacing, voxel_downsampled, voxel_for
from regkit.interfaces import Method
from regkit.interfaces.alignment_start import AlignmentCandidate, AlignmentStart
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.optional import load_library


class Open3DFeatures(AlignmentStart):
    """Open3D's fast point feature histograms, with RANSAC or fast global registration.

    Radii and thresholds are those of Open3D's tutorial on global registration, in voxels.
    """

    kind: Literal["open3d_features"] = "open3d_features"

    search: Literal["ransac", "fgr"] = "ransac"
    """RANSAC (``ransac``), or fast global registration of Zhou, Park and Koltun, 2016 (``fgr``)."""
    points: Annotated[int, Field(ge=100, le=1_000_000)] = 3000
    """Approximate number of points for which features are computed."""
    iterations: Annotated[int, Field(ge=1, le=10_000_000)] = 100_000
    """Greatest number of iterations of RANSAC."""

    def candidates(self, source: Array, target: Array, method: Method) -> list[AlignmentCandidate]:
        """Returns the motion that Open3D finds.

        Raises:
            DataError: If too few features match.
            DependencyError: If Open3D is missing.
        """
        library = load_library("open3d")
        # The spacing as voxel size leaves a sparse cloud almost as it is.
        sizes = [voxel_for(cloud, self.points) or spacing(cloud) for cloud in (source, target)]
        voxel = max(sizes)
        search = library.geometry.KDTreeSearchParamHybrid
        clouds, features = [], []
        for points in (source, target):
            thin = voxel_downsampled(points, voxel)
            cloud = library.geometry.PointCloud(library.utility.Vector3dVector(thin))
            cloud.estimate_normals(search(radius=2.0 * voxel, max_nn=30))
            clouds.append(cloud)
            features.append(
                library.pipelines.registration.compute_fpfh_feature(
                    cloud, search(radius=5.0 * voxel, max_nn=100)
                )
            )
        # Open3D prints warnings to standard output, which is for results.
        with library.utility.VerbosityContextManager(library.utility.VerbosityLevel.Error):
            transform = self._matched(library, clouds, features, voxel)
        if np.array_equal(transform, np.eye(4)):
            raise DataError(
                "too few features of the clouds match; choose another start", place="start"
            )
        name = "RANSAC" if self.search == "ransac" else "fast global registration"
        return [AlignmentCandidate(transform, 2.0 * voxel, f"matched features, by Open3D's {name}")]

    def _matched(self, library: Any, clouds: list[Any], features: list[Any], voxel: float) -> Array:
        registration = library.pipelines.registration
        # A fixed seed makes the result reproducible.
        library.utility.random.seed(0)
        if self.search == "fgr":
            option = registration.FastGlobalRegistrationOption(
                maximum_correspondence_distance=0.5 * voxel, seed=0
            )
            result = registration.registration_fgr_based_on_feature_matching(
                *clouds, *features, option
            )
            return np.asarray(result.transformation)
        distance = 1.5 * voxel
        result = registration.registration_ransac_based_on_feature_matching(
            *clouds,
            *features,
            True,
            distance,
            registration.TransformationEstimationPointToPoint(False),
            3,
            [
                registration.CorrespondenceCheckerBasedOnEdgeLength(0.9),
                registration.CorrespondenceCheckerBasedOnDistance(distance),
            ],
            registration.RANSACConvergenceCriteria(self.iterations, 0.999),
        )
        return np.asarray(result.transformation)
