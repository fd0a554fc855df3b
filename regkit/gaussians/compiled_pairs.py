"""All pairs of K Gaussians with N points, in single precision and vector instructions.

The readable form is ``regkit.gaussians.pairs``. Coordinates are relative to the points' centre, and
moments to the Gaussians' means, so that nothing cancels.
"""

from __future__ import annotations

import numpy as np

from regkit.system.compiled import compiled
from regkit.system.machine_types import (
    Matrix,
    SingleMatrix,
    SingleVector,
    Stack,
    Vector,
)
from regkit.system.single_precision import LOG2_E, logarithm, power_of_two


@compiled(reordered=True, python=False)
def pair_densities(
    points: SingleMatrix,
    means: Matrix,
    precisions: Stack,
    log_scales: Vector,
    densities: SingleMatrix,
    total: SingleVector,
) -> None:
    """Writes exp(log_scale - 1/2 q^T P q) of all pairs, and adds them up for each point.

    Args:
        points: Coordinates, (3, N) [m].
        means: m, (K, 3) [m].
        precisions: P, (K, 3, 3) [1/m^2].
        log_scales: (K,).
        densities: Written, (K, N).
        total: Summands of the sums over the Gaussians, (N,); overwritten by the sums.
    """
    xs, ys, zs = points[0], points[1], points[2]
    half, unit = -0.5 * LOG2_E, LOG2_E
    for k in range(len(means)):
        p, row = precisions[k], densities[k]
        mx, my, mz = np.float32(means[k, 0]), np.float32(means[k, 1]), np.float32(means[k, 2])
        a, b = np.float32(half * p[0, 0]), np.float32(half * p[1, 1])
        c, d = np.float32(half * p[2, 2]), np.float32(-unit * p[0, 1])
        e, f = np.float32(-unit * p[0, 2]), np.float32(-unit * p[1, 2])
        s = np.float32(unit * log_scales[k])
        for j in range(len(total)):
            x, y, z = xs[j] - mx, ys[j] - my, zs[j] - mz
            density = power_of_two(
                x * (a * x + d * y + e * z) + y * (b * y + f * z) + c * z * z + s
            )
            row[j] = density
            total[j] += density


@compiled(reordered=True, python=False)
def pair_moments(
    points: SingleMatrix,
    means: Matrix,
    densities: SingleMatrix,
    factors: SingleVector,
    mass: Vector,
    about: Stack,
) -> None:
    """Writes the moments of ``Moments`` for the weights density x factor of each point.

    Args:
        points: Coordinates, (3, N) [m].
        means: m, (K, 3) [m].
        densities: (K, N).
        factors: (N,).
        mass: Written, (K,).
        about: Written, sum w q (q, 1)^T, (K, 3, 4).
    """
    xs, ys, zs = points[0], points[1], points[2]
    zero = np.float32(0.0)
    for k in range(len(means)):
        row, own = densities[k], about[k]
        mx, my, mz = np.float32(means[k, 0]), np.float32(means[k, 1]), np.float32(means[k, 2])
        m = sx = sy = sz = xx = yy = zz = xy = xz = yz = zero
        for j in range(len(factors)):
            x, y, z = xs[j] - mx, ys[j] - my, zs[j] - mz
            w = row[j] * factors[j]
            wx, wy, wz = w * x, w * y, w * z
            m += w
            sx += wx
            sy += wy
            sz += wz
            xx += wx * x
            yy += wy * y
            zz += wz * z
            xy += wx * y
            xz += wx * z
            yz += wy * z
        mass[k] = m
        own[0, 0], own[0, 1], own[0, 2], own[0, 3] = xx, xy, xz, sx
        own[1, 0], own[1, 1], own[1, 2], own[1, 3] = xy, yy, yz, sy
        own[2, 0], own[2, 1], own[2, 2], own[2, 3] = xz, yz, zz, sz


@compiled(reordered=True, python=False)
def weighted_logarithms(weights: SingleVector, total: SingleVector) -> float:
    """Returns sum w log(total)."""
    energy = 0.0
    for j in range(len(total)):
        energy += weights[j] * logarithm(total[j])
    return energy


@compiled(reordered=True, python=False)
def weighted_sum(weights: SingleVector, total: SingleVector) -> float:
    """Returns sum w total."""
    energy = 0.0
    for j in range(len(total)):
        energy += weights[j] * total[j]
    return energy
