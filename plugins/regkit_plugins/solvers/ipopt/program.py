"""A problem in IPOPT's form: scaled, bounded, evaluated once per point, with the best point."""

from __future__ import annotations

import numpy as np

from regkit.interfaces import Multipliers, Problem
from regkit.system.arrays import Array
from regkit.system.errors import DataError


class Program:
    """The scaled value, its derivatives, the constraints, and the best point so far.

    Args:
        problem: The problem to minimise.
        constraint_tolerance: Largest constraint violation of a feasible point.
        reach: Largest change of a variable without bounds.

    Attributes:
        start: The problem's start projected onto its limits, (m,).
        lower: Lower bounds, all finite, (m,).
        upper: Upper bounds, all finite, (m,).
        constraints: The problem's constraints.
        rows: Number C of constraint rows.
        multipliers: The problem's multipliers, if their shapes match.
        curved: Whether the problem provides curvature.
        scale: The divisor of values: the mean curvature; without curvature the value at the start,
            or if that is zero the largest component of the gradient.
        evaluations: Number of evaluations of the problem.
        best: The best feasible value and its point (m,), if there is one.

    Raises:
        DataError: If the value or gradient at the start is not finite.
    """

    def __init__(self, problem: Problem, constraint_tolerance: float, reach: float) -> None:
        self.constraints = problem.constraints()
        self.rows = 0 if self.constraints is None else len(self.constraints.names)
        self.multipliers = _fitting(problem.multipliers, len(problem.start), self.rows)
        self.evaluations = 0
        self.best: tuple[float, Array] | None = None
        self._problem, self._tolerance = problem, constraint_tolerance
        self._last: tuple[Array, float, Array, Array | None] | None = None
        self.start = problem.projected(problem.start)
        lower, upper = problem.lower, problem.upper
        self.lower = np.where(np.isfinite(lower), lower, np.minimum(self.start, upper) - reach)
        self.upper = np.where(np.isfinite(upper), upper, np.maximum(self.start, lower) + reach)
        value, gradient, matrix = known = self.at(self.start)
        if not all(np.isfinite(part).all() for part in known if part is not None):
            raise DataError(f"the energy ({value}) or its gradient at the start is not finite")
        self.curved = matrix is not None
        self.scale = abs(value) or float(np.abs(gradient).max(initial=0.0)) or 1.0
        if matrix is not None and np.trace(matrix) > 0.0:
            self.scale = float(np.diagonal(matrix).mean())

    def at(self, x: Array) -> tuple[float, Array, Array | None]:
        """Returns the value, gradient (m,), and curvature (m, m) or None, at a point (m,)."""
        if self._last is None or not np.array_equal(self._last[0], x):
            point = x.copy()
            equations = self._problem.normal_equations(point)
            found = equations or (*self._problem.value_and_gradient(point), None)
            self.evaluations += 1
            self._last = (point, *found)
            self._see(point, found[0])
        return self._last[1:]

    def within(self, x: Array) -> Array:
        """Returns a point (m,) if it is feasible, else its projection onto the limits.

        An iterate at which IPOPT is stopped may violate a limit slightly.
        """
        return x if self.allowed(x) else self._problem.projected(x)

    def allowed(self, x: Array) -> bool:
        """Returns whether a point (m,) is feasible."""
        return float(self._beyond(x).max(initial=0.0)) <= self._tolerance

    def worst(self, x: Array) -> tuple[float, str]:
        """Returns the largest violation at x (m,), and the name of its bound or constraint."""
        beyond = self._beyond(x)
        index = int(np.argmax(beyond))
        if self.constraints is None or index < len(x):
            return float(beyond[index]), f"bound of variable {index}"
        return float(beyond[index]), self.constraints.names[index - len(x)]

    def value(self, x: Array) -> Array:
        """Returns the scaled value, (1,)."""
        return np.array([self.at(x)[0] / self.scale])

    def gradient(self, x: Array) -> Array:
        """Returns the scaled gradient, (m,)."""
        return self.at(x)[1] / self.scale

    def constrained(self, x: Array) -> Array:
        """Returns the constraint rows, (C,)."""
        return np.zeros(0) if self.constraints is None else self.constraints.values(x)

    def jacobian(self, x: Array) -> Array:
        """Returns the Jacobian of the constraint rows, (C, m)."""
        return np.zeros((0, len(x))) if self.constraints is None else self.constraints.jacobian(x)

    def curvature(self, x: Array, factor: float, multipliers: Array) -> Array:
        """Returns the Hessian (m, m) of the Lagrangian.

        It is the Gauss-Newton matrix of the value, and exact for the constraints.

        Args:
            x: The point, (m,).
            factor: Factor of the value.
            multipliers: Multipliers of the constraints, (C,).
        """
        matrix = self.at(x)[2]
        assert matrix is not None
        total = factor / self.scale * matrix
        if self.constraints is None:
            return total
        return total + self.constraints.curvature(x, multipliers)

    def stuck(self, x: Array) -> bool:
        """Returns whether ``reach``, rather than a limit, bounds a variable at x (m,)."""
        near = 1e-3 * (self.upper - self.lower)
        left = (x < self.lower + near) & (self.lower > self._problem.lower)
        right = (x > self.upper - near) & (self.upper < self._problem.upper)
        return bool((left | right).any())

    def _beyond(self, x: Array) -> Array:
        """Returns the violations of all bounds, then of all constraints, (m + C,)."""
        beyond = np.maximum(self._problem.lower - x, x - self._problem.upper).clip(min=0.0)
        if self.constraints is None:
            return beyond
        return np.append(beyond, self.constraints.violations(x))

    def _see(self, x: Array, value: float) -> None:
        if self.best is not None and not value < self.best[0]:
            return
        if np.isfinite(value) and self.allowed(x):
            self.best = (value, x)


def _fitting(multipliers: Multipliers | None, size: int, rows: int) -> Multipliers | None:
    """Returns multipliers if they are finite and have the lengths ``size`` and ``rows``."""
    if multipliers is None:
        return None
    bounds, constraints = multipliers.bounds, multipliers.constraints
    fits = bounds.shape == (size,) and constraints.shape == (rows,)
    known = fits and bool(np.isfinite(bounds).all() and np.isfinite(constraints).all())
    return multipliers if known else None
