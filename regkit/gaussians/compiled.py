"""Visible sides of Gaussians, and wrenches and stiffness from moments, in compiled loops.

For a dozen Gaussians NumPy's call overhead would dominate. ``Visible`` and ``Moments`` document
the formulas.
"""

from __future__ import annotations

from math import log, sqrt

import numpy as np

from regkit.system.arrays import Array
from regkit.system.compiled import compiled


@compiled
def visible_sides(
    centres: Array, axes: Array, scales: Array, depth: float, flattening: float
) -> tuple[Array, Array, Array, Array, Array, Array, Array]:
    """Returns means, covariances, C, C^-1 e, e, h and |m| of K Gaussians; see ``Visible``.

    Args:
        centres: m, in the camera frame, (K, 3) [m].
        axes: R_world_primitive, (K, 3, 3).
        scales: Standard deviations, (K, 3) [m].
        depth: Offset of the visible mean towards the camera as a fraction of h.
        flattening: Reduction of the variance along the ray as a fraction of h^2.
    """
    count = len(centres)
    means, pulled, rays = np.empty((count, 3)), np.empty((count, 3)), np.empty((count, 3))
    covariances, whole = np.empty((count, 3, 3)), np.empty((count, 3, 3))
    reaches, distances = np.empty((count, 1)), np.empty((count, 1))
    for k in range(count):
        distance = sqrt(centres[k, 0] ** 2 + centres[k, 1] ** 2 + centres[k, 2] ** 2)
        distances[k, 0] = distance
        for i in range(3):
            rays[k, i] = centres[k, i] / distance
            pulled[k, i] = 0.0
        square = 0.0
        for a in range(3):
            own = 0.0
            for i in range(3):
                own += rays[k, i] * axes[k, i, a]
            square += own * own / scales[k, a] ** 2
            for i in range(3):
                pulled[k, i] += axes[k, i, a] * own / scales[k, a] ** 2
        reach = 2.0 / sqrt(square)
        reaches[k, 0] = reach
        for i in range(3):
            means[k, i] = centres[k, i] - depth * reach * rays[k, i]
            for j in range(3):
                entry = 0.0
                for a in range(3):
                    entry += axes[k, i, a] * scales[k, a] ** 2 * axes[k, j, a]
                whole[k, i, j] = entry
                covariances[k, i, j] = entry - flattening * reach**2 * rays[k, i] * rays[k, j]
    return means, covariances, whole, pulled, rays, reaches, distances


@compiled
def inverses(matrices: Array, variance: float) -> tuple[Array, Array]:
    """Returns the inverses (K, 3, 3) of symmetric M + variance I, and log |M + variance I| (K,)."""
    count = len(matrices)
    result, logarithms = np.empty((count, 3, 3)), np.empty(count)
    for k in range(count):
        m = matrices[k]
        a, b, c = m[0, 0] + variance, m[1, 1] + variance, m[2, 2] + variance
        d, e, f = m[0, 1], m[0, 2], m[1, 2]
        p, q, r = b * c - f * f, e * f - d * c, d * f - b * e
        determinant = a * p + d * q + e * r
        logarithms[k] = log(determinant)
        result[k, 0, 0] = p / determinant
        result[k, 1, 1] = (a * c - e * e) / determinant
        result[k, 2, 2] = (a * b - d * d) / determinant
        result[k, 0, 1] = result[k, 1, 0] = q / determinant
        result[k, 0, 2] = result[k, 2, 0] = r / determinant
        result[k, 1, 2] = result[k, 2, 1] = (d * e - a * f) / determinant
    return result, logarithms


@compiled
def visible_wrenches(
    mass: Array,
    about: Array,
    relative: Array,
    precisions: Array,
    shrinking: Array,
    whole: Array,
    pulled: Array,
    rays: Array,
    reaches: Array,
    distances: Array,
    depth: float,
    flattening: float,
) -> Array:
    """Returns the wrenches (K, 6) of ``Visible.wrenches``.

    Args:
        mass: As in ``Moments``, (K,).
        about: As in ``Moments``, (K, 3, 4).
        relative: As in ``Moments``, (K, 3, 4).
        precisions: As in ``Moments``, (K, 3, 3).
        shrinking: Contribution of log |C| to -G, (K, 3, 3).
        whole: As in ``Visible``, (K, 3, 3) [m^2].
        pulled: As in ``Visible``, (K, 3).
        rays: As in ``Visible``, (K, 3).
        reaches: As in ``Visible``, (K, 1) [m].
        distances: As in ``Visible``, (K, 1) [m].
        depth: Offset of the visible mean towards the camera as a fraction of h.
        flattening: Reduction of the variance along the ray as a fraction of h^2.
    """
    count = len(mass)
    wrenches = np.empty((count, 6))
    first, across, to_ray = np.empty((3, 4)), np.empty(3), np.empty(3)
    levers, spreads, turning = np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3))
    for k in range(count):
        e, h = rays[k], reaches[k, 0]
        for i in range(3):
            for j in range(4):
                first[i, j] = (
                    precisions[k, i, 0] * about[k, 0, j]
                    + precisions[k, i, 1] * about[k, 1, j]
                    + precisions[k, i, 2] * about[k, 2, j]
                )
        for i in range(3):
            for j in range(3):
                levers[i, j] = (
                    first[i, 0] * relative[k, j, 0]
                    + first[i, 1] * relative[k, j, 1]
                    + first[i, 2] * relative[k, j, 2]
                    + first[i, 3] * relative[k, j, 3]
                )
        along = 0.0
        for i in range(3):
            across[i] = 0.0
            along -= first[i, 3] * e[i]
            for j in range(3):
                spreads[i, j] = 0.5 * mass[k] * precisions[k, i, j] - shrinking[k, i, j]
                for a in range(3):
                    spreads[i, j] -= 0.5 * levers[i, a] * precisions[k, a, j]
                across[i] += spreads[i, j] * e[j]
        to_reach = -depth * along
        for i in range(3):
            to_reach -= 2.0 * flattening * h * across[i] * e[i]
        to_reach *= -0.25 * h**3
        turned = 0.0
        for i in range(3):
            to_ray[i] = depth * h * first[i, 3] - 2.0 * flattening * h**2 * across[i]
            to_ray[i] += to_reach * pulled[k, i]
            turned += to_ray[i] * e[i]
        for i in range(3):
            wrenches[k, i] = (to_ray[i] - turned * e[i]) / distances[k, 0] - first[i, 3]
            for j in range(3):
                turning[i, j] = 0.0
                for a in range(3):
                    turning[i, j] += 2.0 * whole[k, i, a] * spreads[a, j]
        for i in range(3):
            a, b = (i + 1) % 3, (i + 2) % 3
            wrenches[k, 3 + i] = turning[a, b] - turning[b, a]
            wrenches[k, 3 + i] += to_reach * (pulled[k, a] * e[b] - pulled[k, b] * e[a])
    return wrenches


@compiled
def stiffness_blocks(
    mass: Array, about: Array, relative: Array, precisions: Array, shift: Array
) -> Array:
    """Returns the Gauss-Newton blocks (K, 6, 6) of ``Moments.stiffness``.

    Args:
        mass: As in ``Moments``, (K,).
        about: As in ``Moments``, (K, 3, 4).
        relative: As in ``Moments``, (K, 3, 4).
        precisions: As in ``Moments``, (K, 3, 3).
        shift: Vectors from the means to the centres of rotation, (K, 3) [m].
    """
    count = len(mass)
    blocks = np.empty((count, 6, 6))
    second, both, lever = np.empty((3, 3)), np.empty((3, 3)), np.empty(3)
    for k in range(count):
        p, s = precisions[k], shift[k]
        for i in range(3):
            lever[i] = about[k, i, 3] - mass[k] * s[i]
            for j in range(3):
                second[i, j] = mass[k] * s[i] * s[j] - about[k, i, 3] * s[j] - s[i] * about[k, j, 3]
                for a in range(4):
                    second[i, j] += about[k, i, a] * relative[k, j, a]
        trace = 0.0
        for i in range(3):
            for j in range(3):
                both[i, j] = (
                    p[i, 0] * second[0, j] + p[i, 1] * second[1, j] + p[i, 2] * second[2, j]
                )
            trace += both[i, i]
        first_trace = p[0, 0] + p[1, 1] + p[2, 2]
        second_trace = second[0, 0] + second[1, 1] + second[2, 2]
        for i in range(3):
            # The columns of -P [lever]x.
            mixed = (
                p[i, 2] * lever[1] - p[i, 1] * lever[2],
                p[i, 0] * lever[2] - p[i, 2] * lever[0],
                p[i, 1] * lever[0] - p[i, 0] * lever[1],
            )
            for j in range(3):
                blocks[k, i, j] = mass[k] * p[i, j]
                blocks[k, i, 3 + j] = blocks[k, 3 + j, i] = mixed[j]
                turn = both[i, j] + both[j, i] - first_trace * second[i, j] - second_trace * p[i, j]
                if i == j:
                    turn += first_trace * second_trace - trace
                blocks[k, 3 + i, 3 + j] = turn
    return blocks
