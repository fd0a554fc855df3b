"""Gaussians that approximate the volume of a segment."""

from __future__ import annotations

import numpy as np

from regkit.body import GaussianParameters, IsotropicGaussianParameters
from regkit.body.deformation import REFLECT
from regkit.fitting.clusters import clusters, spread
from regkit.system.arrays import Array

gaussian, ball = GaussianParameters.fitted, IsotropicGaussianParameters.fitted
"""The Gaussian with the moments of points (N, 3) [m], and the isotropic one."""


def balls(points: Array, count: int) -> tuple[IsotropicGaussianParameters, ...]:
    """Returns ``count`` isotropic Gaussians of clusters of ``points`` (N, 3) [m]."""
    owners = clusters(points, points[spread(points, count)])
    return tuple(ball(points[owners == index]) for index in range(count))


def symmetric_balls(
    points: Array, pairs: int, middle: int
) -> tuple[IsotropicGaussianParameters, ...]:
    """Returns isotropic Gaussians that are symmetric about the plane x = 0.

    Args:
        points: Points that are symmetric about the plane, (N, 3) [m].
        pairs: Number of pairs, left before right.
        middle: Number of Gaussians in the plane.
    """
    half = points[points[:, 0] > 0.0]
    start = half[spread(half, pairs + middle)]
    start = start[np.argsort(-start[:, 0], kind="stable")]
    owners = clusters(half, start, in_plane=middle)
    found: list[IsotropicGaussianParameters] = []
    for index in range(pairs):
        own = half[owners == index]
        found += [ball(own), ball(own * REFLECT)]
    for index in range(pairs, pairs + middle):
        own = half[owners == index]
        found.append(ball(np.concatenate([own, own * REFLECT])))
    return tuple(found)
