"""The paper's similarity, the Gaussian correlation, as a CasADi function."""

from __future__ import annotations

from typing import Any

import numpy as np

from regkit.casadi.configuration import length
from regkit.casadi.kinematics import forward_kinematics
from regkit.primitives import Gaussians
from regkit.skeleton import Skeleton
from regkit.system.arrays import Array
from regkit.system.optional import load_library


def correlation(skeleton: Skeleton, gaussians: Gaussians, count: int) -> Any:
    """Returns the negative correlation of a body's Gaussians with data, eqs. 5 and 8.

    With S = C_i + sigma_j^2 I it is the energy of the kernel ``correlation``::

        - sum_ij w_i w_j sigma_j^3 sqrt(|C_i| / |S|) exp(-1/2 q^T S^-1 q) / sum_j w_j sigma_j^3,

    as the CasADi function (configuration (Q,), points (3, N) [m], weights (N,), variances (N,)
    [m^2]) -> energy. Covariances rotate with their segments.

    Args:
        skeleton: The skeleton.
        gaussians: Gaussians in segment frames.
        count: Number N of points.

    Raises:
        DependencyError: If CasADi is missing.
    """
    ca = load_library("casadi")
    numbers = ca.MX.sym("configuration", length(skeleton))
    points = ca.MX.sym("points", 3, count)
    weights, variances = ca.MX.sym("weights", count), ca.MX.sym("variances", count)
    transforms = forward_kinematics(skeleton)(numbers)
    # Mapping the expression of one point keeps its size independent of the data.
    density = _density(skeleton, gaussians).map(count)
    densities = density(ca.repmat(ca.vec(transforms), 1, count), points, variances.T)
    masses = weights * variances**1.5
    energy = -ca.dot(masses, densities.T) / ca.sum1(masses)
    return ca.Function(
        "correlation", [numbers, points, weights, variances], [energy],
        ["configuration", "points", "weights", "variances"], ["energy"],
    )  # fmt: skip


def _density(skeleton: Skeleton, gaussians: Gaussians) -> Any:
    """Returns the function (transforms (16 S,), point (3,), variance) -> density at the point."""
    ca = load_library("casadi")
    transforms = ca.SX.sym("transforms", 16 * len(skeleton.names))
    point, variance = ca.SX.sym("point", 3), ca.SX.sym("variance")
    by_segment = ca.reshape(transforms, 4, 4 * len(skeleton.names))
    density = ca.SX(0)
    for segment, centre, axes, scales, weight in zip(
        gaussians.segments, gaussians.centres, gaussians.axes, gaussians.scales, gaussians.weights,
        strict=True,
    ):  # fmt: skip
        placed = by_segment[:3, 4 * segment : 4 * segment + 4]
        # S is diagonal in the axes of the Gaussian.
        local = placed[:, :3].T @ (point - placed[:, 3]) - centre
        squares = _squares(scales) + variance
        exponent = ca.sum1((axes.T @ local) ** 2 / squares)
        amplitude = float(weight) * float(np.prod(scales))
        density += (
            amplitude / ca.sqrt(squares[0] * squares[1] * squares[2]) * ca.exp(-0.5 * exponent)
        )
    return ca.Function("density", [transforms, point, variance], [density])


def _squares(scales: Array) -> Any:
    return load_library("casadi").DM(scales**2)
