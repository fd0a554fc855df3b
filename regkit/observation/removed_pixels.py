"""Pixels of points that are left out of preprocessed data: free space, or unknown."""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import NDArray

from regkit.geometry.camera import Camera
from regkit.observation.frame import FARTHEST
from regkit.system.arrays import Array


def depth_of_kept(depth: Array, camera: Camera, points: Array, kept: NDArray[np.bool_]) -> Array:
    """Returns a depth image without the pixels of some points; a pixel is the nearest point's.

    A removed pixel hides what is behind it, so it is unknown (NaN). From the farthest kept point on
    it is free space (0), as in ``Frame.only``.

    Args:
        depth: The image, (H, W) [m].
        camera: Its camera.
        points: The data, of which there may be fewer than pixels, (N, 3) [m].
        kept: Mask of the points that are kept, (N,).
    """
    rows, columns = np.nonzero(depth > 0.0)
    measured = camera.back_projected(depth)
    depths = measured[:, 2]
    removed = ~kept[scipy.spatial.KDTree(points).query(measured)[1]]
    farthest = float(np.percentile(points[kept, 2], FARTHEST)) if kept.any() else -np.inf
    left = depth.copy()
    left[rows[removed], columns[removed]] = np.where(depths[removed] < farthest, np.nan, 0.0)
    return left
