"""Gaussians with the same mean and covariance as a solid, one or several of them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import permutations, product

import numpy as np

from regkit.body.description import GaussianDescription
from regkit.geometry.rotation import from_matrix, to_vector, vector_to_matrix
from regkit.skeleton.joints import Vector
from regkit.system.arrays import Array, Indices

_TURNS = np.array(
    [
        np.diag(signs)[:, order]
        for order in permutations(range(3))
        for signs in product((1.0, -1.0), repeat=3)
        if np.linalg.det(np.diag(signs)[:, order]) > 0.0
    ]
)
"""The 24 ways (24, 3, 3) to name the axes of an ellipsoid x, y and z."""


def gaussian(points: Array) -> GaussianDescription:
    """The Gaussian with the moments of ``points`` (N, 3) [m].

    Its axes are named so that it is turned as little as possible.
    """
    variances, vectors = np.linalg.eigh(np.cov(points.T, bias=True))
    if np.linalg.det(vectors) < 0.0:
        vectors = -vectors
    turns = vectors @ _TURNS
    best = int(np.trace(turns, axis1=1, axis2=2).argmax())
    sigma = np.sqrt(variances @ np.abs(_TURNS[best]))
    rotation = np.degrees(to_vector(from_matrix(turns[best])))
    return GaussianDescription(
        centre=vector(points.mean(axis=0)), sigma=vector(sigma), rotation_deg=vector(rotation, 1)
    )


def ball(points: Array) -> GaussianDescription:
    """The isotropic Gaussian with the mean and the total variance of ``points`` (N, 3) [m]."""
    centre = points.mean(axis=0)
    sigma = np.sqrt(((points - centre) ** 2).sum(axis=1).mean() / 3.0)
    return GaussianDescription(centre=vector(centre), sigma=round(float(sigma), 4))


def balls(points: Array, count: int) -> tuple[GaussianDescription, ...]:
    """``count`` isotropic Gaussians with the moments of clusters of ``points`` (N, 3) [m]."""
    owners = clusters(points, points[spread(points, count)])
    return tuple(ball(points[owners == index]) for index in range(count))


def clusters(points: Array, centres: Array, in_plane: int = 0) -> Indices:
    """Lloyd's k-means: the cluster (N,) of each point, from first centres (K, 3).

    The last ``in_plane`` centres are kept in the plane x = 0.

    Source: Lloyd, Least squares quantization in PCM, IEEE Trans. Inf. Theory 28, 1982.
    """
    centres = centres.copy()
    kept = slice(len(centres) - in_plane, len(centres))
    for _ in range(200):
        centres[kept, 0] = 0.0
        owners = ((points[:, None] - centres) ** 2).sum(axis=2).argmin(axis=1)
        moved = centres.copy()
        for index in np.unique(owners):
            moved[index] = points[owners == index].mean(axis=0)
        moved[kept, 0] = 0.0
        if np.abs(moved - centres).max() < 1e-7:
            break
        centres = moved
    return np.asarray(owners)


def spread(points: Array, count: int) -> Indices:
    """``count`` of the points, (K,), each as far as can be from those before it."""
    chosen = [int(((points - points.mean(axis=0)) ** 2).sum(axis=1).argmax())]
    distances = ((points - points[chosen[0]]) ** 2).sum(axis=1)
    while len(chosen) < count:
        chosen.append(int(distances.argmax()))
        distances = np.minimum(distances, ((points - points[chosen[-1]]) ** 2).sum(axis=1))
    return np.array(chosen)


def vector(values: Array, decimals: int = 4) -> Vector:
    """Three rounded numbers; 4 decimals are a tenth of a millimetre."""
    x, y, z = (round(float(value), decimals) + 0.0 for value in values)
    return (x, y, z)


def mixture(gaussians: Sequence[GaussianDescription]) -> Array:
    """The covariance (3, 3) of several Gaussians together, each of the same weight [m^2]."""
    centres = np.array([one.centre for one in gaussians])
    turns = vector_to_matrix(np.radians([one.rotation_deg for one in gaussians]))
    axes = turns * np.array([np.broadcast_to(one.sigma, 3) for one in gaussians])[:, None]
    own = axes @ np.swapaxes(axes, 1, 2)
    return np.asarray(np.cov(centres.T, bias=True) + own.mean(axis=0))
