"""Limits of ball joints as constraints on the coordinates of a pose."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from regkit.casadi import ball_limits
from regkit.casadi.configuration import length
from regkit.casadi.evaluation import Evaluation
from regkit.casadi.rotations import exponential, product
from regkit.interfaces import Constraints
from regkit.skeleton import Skeleton
from regkit.system.arrays import Array
from regkit.system.optional import load_library


@dataclass(frozen=True)
class _Rows:
    """C constraints on M consecutive coordinates, derived once per skeleton.

    Attributes:
        names: Name of each constraint, (C,).
        lower: Lower bounds, (C,).
        upper: Upper bounds, (C,).
        values: (coordinates (M,), parameters) -> rows (C,).
        jacobian: (coordinates (M,), parameters) -> (C, M).
        curvature: (coordinates (M,), parameters, multipliers (C,)) -> (M, M).
    """

    names: tuple[str, ...]
    lower: Array
    upper: Array
    values: Evaluation
    jacobian: Evaluation
    curvature: Evaluation


class ChartConstraints(Constraints):
    """Constraints on consecutive coordinates among all m.

    Args:
        rows: The constraints.
        parameters: Values other than the coordinates on which the constraints depend.
        own: Slice of the constrained coordinates among all m.
        count: Number m of coordinates.
    """

    def __init__(self, rows: _Rows, parameters: Array, own: slice, count: int) -> None:
        self.names, self.lower, self.upper = rows.names, rows.lower, rows.upper
        self._rows, self._parameters, self._own, self._count = rows, parameters, own, count

    def values(self, x: Array) -> Array:
        """Returns the values (C,) of the constraints at x (m,)."""
        return self._rows.values(x[self._own], self._parameters)[:, 0]

    def jacobian(self, x: Array) -> Array:
        """Returns the Jacobian (C, m) of the constraints at x (m,)."""
        jacobian = np.zeros((len(self.names), self._count))
        jacobian[:, self._own] = self._rows.jacobian(x[self._own], self._parameters)
        return jacobian

    def curvature(self, x: Array, multipliers: Array) -> Array:
        """Returns the Hessian (m, m) at x (m,) of the sum of multipliers (C,) times constraints."""
        curvature = np.zeros((self._count, self._count))
        own = self._rows.curvature(x[self._own], self._parameters, multipliers)
        curvature[self._own, self._own] = own
        return curvature


def tangent_constraints(skeleton: Skeleton, balls: Array, count: int) -> Constraints | None:
    """Returns the ball joint limits on m steps of the tangent space, or None without limits.

    Args:
        skeleton: The skeleton with its limits.
        balls: Quaternions of the ball joints in the start pose, (n_ball, 4).
        count: Number m of coordinates.
    """
    rows = _tangent_rows(skeleton)
    if not rows.names:
        return None
    return ChartConstraints(rows, balls.ravel(), skeleton.ball_dofs, count)


def quaternion_constraints(skeleton: Skeleton, count: int) -> Constraints | None:
    """Returns the ball joint limits and unit norms on m coordinates with un-normalised quaternions.

    Without the norms the length of a quaternion would be undetermined. None if the skeleton has no
    quaternions.
    """
    rows = _quaternion_rows(skeleton)
    if not rows.names:
        return None
    first = 3 if skeleton.free else 0
    quaternions = len(skeleton.ball_links) + int(skeleton.free)
    return ChartConstraints(rows, np.zeros(0), slice(first, first + 4 * quaternions), count)


@lru_cache(maxsize=16)
def _tangent_rows(skeleton: Skeleton) -> _Rows:
    ca = load_library("casadi")
    balls = len(skeleton.ball_links)
    steps, starts = ca.SX.sym("steps", 3 * balls), ca.SX.sym("starts", 4 * balls)
    balls_after = [
        product(starts[4 * ball : 4 * ball + 4], exponential(steps[3 * ball : 3 * ball + 3]))
        for ball in range(balls)
    ]
    limits = ball_limits(skeleton)
    rows = limits.function(_configuration(skeleton, ca.vertcat(ca.SX(0, 1), *balls_after)))
    return _derived(limits.names, rows, limits.lower, limits.upper, steps, starts)


@lru_cache(maxsize=16)
def _quaternion_rows(skeleton: Skeleton) -> _Rows:
    ca = load_library("casadi")
    balls, free = len(skeleton.ball_links), int(skeleton.free)
    quaternions = ca.SX.sym("quaternions", 4 * (balls + free))
    limits = ball_limits(skeleton)
    rows = limits.function(_configuration(skeleton, quaternions[4 * free :]))
    norms = [
        0.5 * (ca.sumsqr(quaternions[4 * index : 4 * index + 4]) - 1.0)
        for index in range(balls + free)
    ]
    names = (*limits.names, *(f"norm of quaternion {index}" for index in range(len(norms))))
    zeros = np.zeros(len(norms))
    return _derived(
        names,
        ca.vertcat(rows, *norms),
        np.append(limits.lower, zeros),
        np.append(limits.upper, zeros),
        quaternions,
        ca.SX.sym("nothing", 0),
    )


def _configuration(skeleton: Skeleton, balls: Any) -> Any:
    """Returns a configuration with these balls (4 n_ball,) and zeros for all other joints."""
    ca = load_library("casadi")
    first = 7 if skeleton.free else 0
    rest = length(skeleton) - first - 4 * len(skeleton.ball_links)
    return ca.vertcat(ca.SX.zeros(first), balls, ca.SX.zeros(rest))


def _derived(
    names: tuple[str, ...], rows: Any, lower: Array, upper: Array, moved: Any, parameters: Any
) -> _Rows:
    """Returns rows with their first and second derivatives to ``moved``."""
    ca = load_library("casadi")
    multipliers = ca.SX.sym("multipliers", len(names))
    curvature = ca.hessian(ca.dot(multipliers, rows), moved)[0]
    both = [moved, parameters]
    return _Rows(
        names,
        lower,
        upper,
        Evaluation(ca.Function("values", both, [ca.densify(rows)])),
        Evaluation(ca.Function("jacobian", both, [ca.densify(ca.jacobian(rows, moved))])),
        Evaluation(ca.Function("curvature", [*both, multipliers], [ca.densify(curvature)])),
    )
