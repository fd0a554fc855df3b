"""Initial alignment in any orientation by matching local surface features."""

from __future__ import annotations

from typing import Any

import numpy as np

from regkit.clouds import spacing, voxel_downsampled, voxel_for
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.optional import load_library

FEATURE_POINTS = 3000
"""Approximate number of points for which features are computed."""


def by_features(source: Array, target: Array) -> Array:
    """Estimates T_target_source (4, 4) by RANSAC on FPFH correspondences, with Open3D.

    Radii and thresholds are those of Open3D's tutorial on global registration, in voxels.

    Args:
        source: Source points, (N, 3) [m].
        target: Target points, (M, 3) [m].

    Raises:
        DataError: If too few features match.
        DependencyError: If Open3D is missing.
    """
    library = load_library("open3d")
    # The spacing as voxel size leaves a sparse cloud almost as it is.
    voxels = [voxel_for(points, FEATURE_POINTS) or spacing(points) for points in (source, target)]
    voxel = max(voxels)
    clouds, features = [], []
    for points in (source, target):
        cloud = library.geometry.PointCloud(
            library.utility.Vector3dVector(voxel_downsampled(points, voxel))
        )
        search = library.geometry.KDTreeSearchParamHybrid
        cloud.estimate_normals(search(radius=2.0 * voxel, max_nn=30))
        clouds.append(cloud)
        features.append(
            library.pipelines.registration.compute_fpfh_feature(
                cloud, search(radius=5.0 * voxel, max_nn=100)
            )
        )
    # Open3D prints warnings to standard output, which is for results.
    with library.utility.VerbosityContextManager(library.utility.VerbosityLevel.Error):
        transform = _matched(library, clouds, features, 1.5 * voxel)
    if np.array_equal(transform, np.eye(4)):
        raise DataError("too few features of the clouds match; choose another start", place="start")
    return transform


def _matched(library: Any, clouds: list[Any], features: list[Any], distance: float) -> Array:
    registration = library.pipelines.registration
    # A fixed seed makes the result reproducible.
    library.utility.random.seed(0)
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
        registration.RANSACConvergenceCriteria(100_000, 0.999),
    )
    return np.asarray(result.transformation)
