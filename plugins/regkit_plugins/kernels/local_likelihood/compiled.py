"""Likelihood of points under their nearest Gaussians, in one compiled loop over the pairs.

``BoundLocalLikelihood`` documents the formulas.
"""

from __future__ import annotations

from math import exp, log, sqrt

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled


@compiled
def flattened(variances: Array, normals: Array, flatness: float) -> Array:
    """Returns covariances sigma^2 (I - (1 - flatness^2) n n^T) of N data Gaussians, (N, 6).

    A symmetric matrix is stored as its entries xx, yy, zz, xy, xz, yz.

    Args:
        variances: sigma^2, (N,) [m^2].
        normals: Unit normals n, (N, 3).
        flatness: Standard deviation along the normal as a fraction of sigma.
    """
    count = len(variances)
    covariances = np.empty((count, 6))
    lost = 1.0 - flatness**2
    for j in range(count):
        x, y, z = normals[j]
        covariances[j, 0] = variances[j] * (1.0 - lost * x * x)
        covariances[j, 1] = variances[j] * (1.0 - lost * y * y)
        covariances[j, 2] = variances[j] * (1.0 - lost * z * z)
        covariances[j, 3] = -variances[j] * lost * x * y
        covariances[j, 4] = -variances[j] * lost * x * z
        covariances[j, 5] = -variances[j] * lost * y * z
    return covariances


@compiled
def local_mixture(
    points: Array,
    point_weights: Array,
    point_covariances: Array,
    neighbours: Indices,
    means: Array,
    covariances: Array,
    mixing: Array,
    background: float,
    curvature: bool,
) -> tuple[float, Array, Array, Array]:
    """Returns energy, wrenches (K, 6), blocks (K, 6, 6) and inlier probabilities (N,).

    Args:
        points: Data points, (N, 3) [m].
        point_weights: Weights of the points, (N,), summing to one.
        point_covariances: Covariances of the points, (N, 6) [m^2]; see ``flattened``.
        neighbours: Indices of each point's Gaussians, (N, k); K stands for none.
        means: Means of the Gaussians, (K, 3) [m].
        covariances: Covariances of the Gaussians, (K, 3, 3) [m^2].
        mixing: Mixture weights divided by (2 pi)^(3/2), (K,).
        background: Density of outliers [1/m^3].
        curvature: Whether to compute blocks; otherwise their array is empty.
    """
    count, near = neighbours.shape
    total = len(means)
    energy = 0.0
    wrenches = np.zeros((total, 6))
    blocks = np.zeros((total if curvature else 0, 6, 6))
    inliers = np.empty(count)
    densities, inverses, residuals = np.empty(near), np.empty((near, 6)), np.empty((near, 3))
    pulled, turned = np.empty((3, 3)), np.empty((3, 3))
    for j in range(count):
        density = background
        for a in range(near):
            i = neighbours[j, a]
            densities[a] = 0.0
            if i >= total:
                continue
            m = covariances[i]
            xx, yy = m[0, 0] + point_covariances[j, 0], m[1, 1] + point_covariances[j, 1]
            zz, xy = m[2, 2] + point_covariances[j, 2], m[0, 1] + point_covariances[j, 3]
            xz, yz = m[0, 2] + point_covariances[j, 4], m[1, 2] + point_covariances[j, 5]
            p, q, r = yy * zz - yz * yz, yz * xz - xy * zz, xy * yz - yy * xz
            determinant = xx * p + xy * q + xz * r
            own = inverses[a]
            own[0], own[3], own[4] = p / determinant, q / determinant, r / determinant
            own[1] = (xx * zz - xz * xz) / determinant
            own[2] = (xx * yy - xy * xy) / determinant
            own[5] = (xy * xz - xx * yz) / determinant
            x, y = points[j, 0] - means[i, 0], points[j, 1] - means[i, 1]
            z = points[j, 2] - means[i, 2]
            residuals[a, 0], residuals[a, 1], residuals[a, 2] = x, y, z
            square = own[0] * x * x + own[1] * y * y + own[2] * z * z
            square += 2.0 * (own[3] * x * y + own[4] * x * z + own[5] * y * z)
            densities[a] = mixing[i] / sqrt(determinant) * exp(-0.5 * square)
            density += densities[a]
        energy -= point_weights[j] * log(density)
        inliers[j] = 1.0 - background / density
        for a in range(near):
            share = densities[a] / density
            if share < 1e-6:
                continue
            share *= point_weights[j]
            i, own = neighbours[j, a], inverses[a]
            x, y, z = residuals[a]
            u = own[0] * x + own[3] * y + own[4] * z
            v = own[3] * x + own[1] * y + own[5] * z
            w = own[4] * x + own[5] * y + own[2] * z
            m = covariances[i]
            # The force acts at the mean of the product; (lx, ly, lz) is its lever from m_i.
            lx = m[0, 0] * u + m[0, 1] * v + m[0, 2] * w
            ly = m[0, 1] * u + m[1, 1] * v + m[1, 2] * w
            lz = m[0, 2] * u + m[1, 2] * v + m[2, 2] * w
            # The antisymmetric part of C P is the derivative of log |S| to the rotation.
            yz_ = m[1, 0] * own[4] + m[1, 1] * own[5] + m[1, 2] * own[2]
            zy_ = m[2, 0] * own[3] + m[2, 1] * own[1] + m[2, 2] * own[5]
            xz_ = m[0, 0] * own[4] + m[0, 1] * own[5] + m[0, 2] * own[2]
            zx_ = m[2, 0] * own[0] + m[2, 1] * own[3] + m[2, 2] * own[4]
            xy_ = m[0, 0] * own[3] + m[0, 1] * own[1] + m[0, 2] * own[5]
            yx_ = m[1, 0] * own[0] + m[1, 1] * own[3] + m[1, 2] * own[4]
            wrench = wrenches[i]
            wrench[0] -= share * u
            wrench[1] -= share * v
            wrench[2] -= share * w
            wrench[3] += share * (v * lz - w * ly + yz_ - zy_)
            wrench[4] += share * (w * lx - u * lz + zx_ - xz_)
            wrench[5] += share * (u * ly - v * lx + xy_ - yx_)
            if not curvature:
                continue
            pulled[0, 0], pulled[1, 1], pulled[2, 2] = own[0], own[1], own[2]
            pulled[0, 1] = pulled[1, 0] = own[3]
            pulled[0, 2] = pulled[2, 0] = own[4]
            pulled[1, 2] = pulled[2, 1] = own[5]
            block = blocks[i]
            for c in range(3):
                # The columns of -P [l]x.
                turned[c, 0] = pulled[c, 2] * ly - pulled[c, 1] * lz
                turned[c, 1] = pulled[c, 0] * lz - pulled[c, 2] * lx
                turned[c, 2] = pulled[c, 1] * lx - pulled[c, 0] * ly
            for c in range(3):
                for d in range(3):
                    block[c, d] += share * pulled[c, d]
                    block[c, 3 + d] += share * turned[c, d]
                    block[3 + d, c] += share * turned[c, d]
                block[3, 3 + c] += share * (turned[2, c] * ly - turned[1, c] * lz)
                block[4, 3 + c] += share * (turned[0, c] * lz - turned[2, c] * lx)
                block[5, 3 + c] += share * (turned[1, c] * lx - turned[0, c] * ly)
    return energy, wrenches, blocks, inliers
