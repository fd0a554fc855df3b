"""Likelihood of points under the nearest Gaussians of a rigid body, in one compiled loop.

``BoundLocalLikelihood`` documents the formulas. Here they are summed over the body, in its frame:
the data move, and the Gaussians, their covariances and the tree of their means stay as they are.
"""

from __future__ import annotations

from math import exp, log, sqrt

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled


@compiled
def rigid_mixture(
    points: Array,
    directions: Array,
    variances: Array,
    weights: Array,
    neighbours: Indices,
    flatness: float,
    means: Array,
    covariances: Array,
    mixing: Array,
    background: float,
    transform: Array,
    inliers: Array,
    begin: int,
    end: int,
) -> tuple[float, Array, Array]:
    """Returns energy, wrench (6,) and block (6, 6) about the body's origin, in the body's axes.

    Args:
        points: Data points in the world, (N, 3) [m].
        directions: Unit normals at the points, (N, 3).
        variances: Variances of the points along their surface, (N,) [m^2].
        weights: Weights of the points.
        neighbours: Indices of each point's Gaussians, (N, k); K stands for none.
        flatness: Standard deviation of a data Gaussian along the normal, relative to the surface.
        means: Means of the Gaussians in the body's frame, (K, 3) [m].
        covariances: Their covariances xx, yy, zz, xy, xz, yz in the body's frame, (K, 6) [m^2].
        mixing: Mixture weights divided by (2 pi)^(3/2), (K,).
        background: Density of outliers [1/m^3].
        transform: T_world_body, (4, 4).
        inliers: Inlier probabilities, (N,); set.
        begin: First point of the sum.
        end: The one after the last.
    """
    near = neighbours.shape[1]
    total = len(means)
    lost = 1.0 - flatness**2
    r00, r01, r02, tx = transform[0]
    r10, r11, r12, ty = transform[1]
    r20, r21, r22, tz = transform[2]
    energy = 0.0
    fx = fy = fz = mx = my = mz = 0.0
    axx = ayy = azz = axy = axz = ayz = 0.0
    bxx = bxy = bxz = byx = byy = byz = bzx = bzy = bzz = 0.0
    cxx = cyy = czz = cxy = cxz = cyz = 0.0
    pairs = np.empty((near, 16))
    for j in range(begin, end):
        x, y, z = points[j, 0] - tx, points[j, 1] - ty, points[j, 2] - tz
        px = r00 * x + r10 * y + r20 * z
        py = r01 * x + r11 * y + r21 * z
        pz = r02 * x + r12 * y + r22 * z
        x, y, z = directions[j, 0], directions[j, 1], directions[j, 2]
        nx = r00 * x + r10 * y + r20 * z
        ny = r01 * x + r11 * y + r21 * z
        nz = r02 * x + r12 * y + r22 * z
        variance = variances[j]
        flat = -variance * lost
        dxx, dyy, dzz = (
            variance + flat * nx * nx,
            variance + flat * ny * ny,
            variance + flat * nz * nz,
        )
        dxy, dxz, dyz = flat * nx * ny, flat * nx * nz, flat * ny * nz
        density = background
        for a in range(near):
            i = neighbours[j, a]
            pair = pairs[a]
            pair[0] = 0.0
            if i >= total:
                continue
            m = covariances[i]
            sxx, syy, szz = m[0] + dxx, m[1] + dyy, m[2] + dzz
            sxy, sxz, syz = m[3] + dxy, m[4] + dxz, m[5] + dyz
            p, q, r = syy * szz - syz * syz, syz * sxz - sxy * szz, sxy * syz - syy * sxz
            determinant = sxx * p + sxy * q + sxz * r
            inverse = 1.0 / determinant
            p, q, r = p * inverse, q * inverse, r * inverse
            s, t = (sxx * szz - sxz * sxz) * inverse, (sxy * sxz - sxx * syz) * inverse
            w = (sxx * syy - sxy * sxy) * inverse
            x, y, z = px - means[i, 0], py - means[i, 1], pz - means[i, 2]
            ux, uy, uz = p * x + q * y + r * z, q * x + s * y + t * z, r * x + t * y + w * z
            square = ux * x + uy * y + uz * z
            pair[0] = mixing[i] * sqrt(inverse) * exp(-0.5 * square)
            density += pair[0]
            pair[1], pair[2], pair[3] = ux, uy, uz
            pair[4], pair[5], pair[6], pair[7], pair[8], pair[9] = p, s, w, q, r, t
        weight = weights[j]
        energy -= weight * log(density)
        inliers[j] = 1.0 - background / density
        scale = 1.0 / density
        for a in range(near):
            pair = pairs[a]
            share = pair[0] * scale
            if share < 1e-6:
                continue
            share *= weight
            i = neighbours[j, a]
            m = covariances[i]
            ux, uy, uz = pair[1], pair[2], pair[3]
            pxx, pyy, pzz, pxy, pxz, pyz = pair[4], pair[5], pair[6], pair[7], pair[8], pair[9]
            # The force acts at the mean (x, y, z) of the product.
            x = means[i, 0] + m[0] * ux + m[3] * uy + m[4] * uz
            y = means[i, 1] + m[3] * ux + m[1] * uy + m[5] * uz
            z = means[i, 2] + m[4] * ux + m[5] * uy + m[2] * uz
            # The antisymmetric part of C P is the derivative of log |S| to the rotation.
            vx = m[3] * pxz + m[1] * pyz + m[5] * pzz - m[4] * pxy - m[5] * pyy - m[2] * pyz
            vy = m[4] * pxx + m[5] * pxy + m[2] * pxz - m[0] * pxz - m[3] * pyz - m[4] * pzz
            vz = m[0] * pxy + m[3] * pyy + m[4] * pyz - m[3] * pxx - m[1] * pxy - m[5] * pxz
            fx -= share * ux
            fy -= share * uy
            fz -= share * uz
            mx += share * (uy * z - uz * y + vx)
            my += share * (uz * x - ux * z + vy)
            mz += share * (ux * y - uy * x + vz)
            pxx, pyy, pzz = share * pxx, share * pyy, share * pzz
            pxy, pxz, pyz = share * pxy, share * pxz, share * pyz
            # T = -P [e]x
            txx, txy, txz = pxz * y - pxy * z, pxx * z - pxz * x, pxy * x - pxx * y
            tyx, tyy, tyz = pyz * y - pyy * z, pxy * z - pyz * x, pyy * x - pxy * y
            tzx, tzy, tzz = pzz * y - pyz * z, pxz * z - pzz * x, pyz * x - pxz * y
            axx += pxx
            ayy += pyy
            azz += pzz
            axy += pxy
            axz += pxz
            ayz += pyz
            bxx += txx
            bxy += txy
            bxz += txz
            byx += tyx
            byy += tyy
            byz += tyz
            bzx += tzx
            bzy += tzy
            bzz += tzz
            cxx += tzx * y - tyx * z
            cyy += txy * z - tzy * x
            czz += tyz * x - txz * y
            cxy += tzy * y - tyy * z
            cxz += tzz * y - tyz * z
            cyz += txz * z - tzz * x
    wrench = np.array([fx, fy, fz, mx, my, mz])
    block = np.array([
        [axx, axy, axz, bxx, bxy, bxz],
        [axy, ayy, ayz, byx, byy, byz],
        [axz, ayz, azz, bzx, bzy, bzz],
        [bxx, byx, bzx, cxx, cxy, cxz],
        [bxy, byy, bzy, cxy, cyy, cyz],
        [bxz, byz, bzz, cxz, cyz, czz],
    ])  # fmt: skip
    return energy, wrench, block


@compiled
def turned(axes: Array, squares: Array, order: Indices) -> Array:
    """Returns covariances xx, yy, zz, xy, xz, yz of Gaussians in an order (K,), (K, 6) [m^2].

    Args:
        axes: R_body_gaussian, (K, 3, 3).
        squares: Variances along the Gaussians' own axes, (K, 3) [m^2].
        order: Indices of Gaussians, (K,).
    """
    covariances = np.zeros((len(order), 6))
    for n in range(len(order)):
        one, c = axes[order[n]], covariances[n]
        for a in range(3):
            x, y, z, square = one[0, a], one[1, a], one[2, a], squares[order[n], a]
            c[0] += square * x * x
            c[1] += square * y * y
            c[2] += square * z * z
            c[3] += square * x * y
            c[4] += square * x * z
            c[5] += square * y * z
    return covariances
