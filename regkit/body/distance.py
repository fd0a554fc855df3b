"""The two-sided distance between a posed body and a cloud.

The distances from data to model show which points the body does not cover; those from model to data
show which parts of the body have no points. Either side alone accepts a body of the wrong size.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from regkit.geometry.capsules import AxisPoints, Capsules
from regkit.skeleton import Placement
from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class SurfaceDistances:
    """Distances between data and spheres on the axes of capsules, zero where the body fits.

    Attributes:
        lengths: Signed distances from the spheres' surfaces, (R,) [m].
        directions: Unit directions of the distances from the body to the data, (R, 3); zero where a
            distance is zero and constant.
        points: Points on the lines through the spheres' centres along the directions, (R, 3) [m].
        segments: Segment of each sphere, (R,).
        capsules: Capsule of each sphere, (R,).
        along: Position of the centre on the capsule's axis, from 0 to 1, (R,).
        count: Number of distances that are known; the others are zero.
    """

    lengths: Array
    directions: Array
    points: Array
    segments: Indices
    capsules: Indices
    along: Array
    count: int

    def rows(self, placement: Placement) -> Array:
        """Returns the derivative (R, n) of the distances to the degrees of freedom."""
        return placement.rows(self.segments, self.points, -self.directions)


def data_to_model(
    capsules: Capsules, points: Array, tangent_at: Array | None = None
) -> SurfaceDistances:
    """Returns the distances of points to the surface of placed capsules, negative inside.

    Args:
        capsules: Capsules in the world.
        points: Points in the world, (N, 3) [m].
        tangent_at: Points (N, 3) [m] near the surface; if given, each distance is measured to the
            tangent plane at the nearest surface point of ``tangent_at``.
    """
    feet = points if tangent_at is None else tangent_at
    nearest, distances, directions = capsules.nearest(feet)
    start, end = capsules.ends[nearest, 0], capsules.ends[nearest, 1]
    first, last = capsules.radii[nearest].T
    # The nearest sphere's centre is on the axis, one radius plus the distance behind the point.
    axis, widening = end - start, last - first
    reached = feet - start - (distances + first)[:, None] * directions
    square = np.maximum((axis**2).sum(axis=1), 1e-12)
    along = (reached * axis).sum(axis=1) / (square + widening * (directions * axis).sum(axis=1))
    along = np.clip(along, 0.0, 1.0)
    lengths = distances
    if tangent_at is not None:
        lengths = distances + ((points - feet) * directions).sum(axis=1)
    return SurfaceDistances(
        lengths=lengths,
        directions=directions,
        points=feet,
        segments=capsules.segments[nearest],
        capsules=nearest,
        along=along,
        count=len(points),
    )


def model_to_data(
    axes: AxisPoints, cloud: scipy.spatial.KDTree, observable: NDArray[np.bool_] | None = None
) -> SurfaceDistances:
    """Returns the distances of spheres on a body's axes, in the world, to the nearest points.

    Args:
        axes: The spheres.
        cloud: The data.
        observable: Mask of the spheres that the data would show, (R,); the others have the distance
            zero. By default all of them.
    """
    distances, nearest = cloud.query(axes.points)
    lengths = np.maximum(distances - axes.radii, 0.0)
    if observable is not None:
        lengths = np.where(observable, lengths, 0.0)
    offsets = np.asarray(cloud.data)[nearest] - axes.points
    return SurfaceDistances(
        lengths=lengths,
        directions=offsets / np.maximum(distances, 1e-9)[:, None] * (lengths > 0.0)[:, None],
        points=axes.points,
        segments=axes.segments,
        capsules=axes.capsules,
        along=axes.along,
        count=len(axes.points) if observable is None else int(observable.sum()),
    )
