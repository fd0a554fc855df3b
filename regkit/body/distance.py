"""The two-sided distance between a posed body and a cloud.

The distances of the data to the model show which points the body does not cover; those of the model
to the data show which parts of the body have no points. Either side alone accepts a body of a wrong
size.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import KDTree

from regkit.geometry.capsules import AxisPoints, Capsules
from regkit.skeleton import Placement
from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class SurfaceDistances:
    """Distances between data and spheres on the axes of capsules, zero where the body fits.

    Attributes:
        lengths: Signed distances from the spheres' surfaces, (R,) [m].
        directions: From the body to the data, the directions in which the distances are measured,
            (R, 3): unit vectors, or zero where a distance is zero and stays so.
        points: Points (R, 3) [m] on the lines through the spheres' centres along the directions.
        segments: The segment of each, (R,).
        capsules: The capsule of each, (R,).
        along: Position of the centre on the capsule's axis, from 0 to 1, (R,).
    """

    lengths: Array
    directions: Array
    points: Array
    segments: Indices
    capsules: Indices
    along: Array

    def rows(self, placement: Placement) -> Array:
        """Returns the derivative (R, n) of the distances to the degrees of freedom."""
        return placement.rows(self.segments, self.points, -self.directions)


def data_to_model(
    capsules: Capsules, points: Array, tangent_at: Array | None = None
) -> SurfaceDistances:
    """Distances of points to the surface of placed capsules, negative inside.

    Args:
        capsules: In the world.
        points: (N, 3) [m].
        tangent_at: Points (N, 3) [m] near the surface; each distance is then measured to the
            tangent plane of the surface nearest to such a point.
    """
    feet = points if tangent_at is None else tangent_at
    nearest, distances, directions = capsules.nearest(feet)
    start, end = capsules.ends[nearest, 0], capsules.ends[nearest, 1]
    first, last = capsules.radii[nearest].T
    # The nearest sphere's centre is on the axis, its radius and the distance behind the point.
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
    )


def model_to_data(axes: AxisPoints, cloud: KDTree) -> SurfaceDistances:
    """Distances of spheres on a body's axes, placed in the world, to their nearest points."""
    distances, nearest = cloud.query(axes.points)
    lengths = np.maximum(distances - axes.radii, 0.0)
    ways = np.asarray(cloud.data)[nearest] - axes.points
    return SurfaceDistances(
        lengths=lengths,
        directions=ways / np.maximum(distances, 1e-9)[:, None] * (lengths > 0.0)[:, None],
        points=axes.points,
        segments=axes.segments,
        capsules=axes.capsules,
        along=axes.along,
    )
