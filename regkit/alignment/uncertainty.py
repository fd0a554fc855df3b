"""The covariance of a rigid alignment, from the offsets that it leaves."""

from __future__ import annotations

import numpy as np

from regkit.clouds.agreement import Agreement
from regkit.clouds.compiled_normals import least_directions
from regkit.clouds.neighbourhoods import NEIGHBOURS
from regkit.clouds.tree import Tree
from regkit.geometry.rigid import transformed
from regkit.geometry.rotation import cross
from regkit.registration import effective_points
from regkit.system.arrays import Array

COUNT = 1000
"""Largest number of source points that are compared."""

REACH = 4.0
"""Distance up to which an offset counts, in maximum correspondence distances: beyond the matched
points are those that show how far a method may be off."""

UNPAIRED = 10.0
"""Growth of the variance with the shares of both clouds that have no correspondence."""

NEAREST = 1.7
"""Growth of the variance because the nearest points are nearer than the right ones."""

FINEST = 0.03
"""Smallest standard deviation of an offset, in maximum correspondence distances: a method ends
before it is exact. These four were chosen on bunny pairs of the seeds 20 to 25."""


def alignment_covariance(
    source: Array, target: Tree, transform: Array, agreement: Agreement
) -> Array:
    """Returns the covariance (6, 6) of a twist from the found to the true alignment.

    The twist is linear first, in the target's axes: the centroid of the aligned source moves by
    t [m], and the source turns about it by the rotation vector w [rad].

    The information is that of the distances to the tangent planes of the nearest target points, so
    that a surface that slides along itself has a large variance in that direction. Their variance
    and their effective number are those of the offsets to these points. It is the same for every
    method. What is not determined at all is within a turn, and within the source's size.

    Args:
        source: Source points, (N, 3) [m].
        target: The target.
        transform: T_target_source, (4, 4).
        agreement: How well the clouds match, with the maximum correspondence distance [m].
    """
    moved = transformed(transform, source)
    size = float(np.linalg.norm(np.ptp(source, axis=0)))
    loose = np.diag([1.0 / size**2] * 3 + [3.0 / np.pi**2] * 3)
    some = moved[:: -(-len(moved) // COUNT)]
    distances, nearest = target.nearest(some, 1, REACH * agreement.distance)
    paired = np.isfinite(distances[:, 0])
    if not paired.any():
        return np.asarray(np.linalg.inv(loose))
    points, feet = some[paired], target.points[nearest[paired, 0]]
    _, around = target.nearest(feet, min(NEIGHBOURS, len(target)))
    planes = least_directions(target.points, around)
    offsets = points - feet
    finest = FINEST * agreement.distance
    variance = max(NEAREST * float((offsets**2).mean()), finest**2)
    total = round(len(moved) * float(paired.mean()))
    count = effective_points(points, offsets / np.sqrt(variance), np.ones(len(points)), size, total)
    # Offsets that are all zero tell no correlation; then only the finest resolution counts.
    share = 1.0 if np.isnan(count) else count / len(points)
    unpaired = 2.0 - agreement.fitness - agreement.overlap
    rows = np.concatenate([planes, cross(points - moved.mean(axis=0), planes)], axis=1)
    information = share / (variance * (1.0 + UNPAIRED * unpaired)) * rows.T @ rows
    return np.asarray(np.linalg.inv(information + loose))
