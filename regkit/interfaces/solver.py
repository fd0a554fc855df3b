"""Solvers, and their problems: smooth functions on a box with constraints."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from regkit.config.plugin import Plugin
from regkit.system.arrays import Array
from regkit.system.errors import PluginError


class Constraints(ABC):
    """Smooth functions of x in C rows, with bounds on a solution.

    Attributes:
        names: Name of each row for messages, (C,).
        lower: Lower bounds, (C,), possibly -inf.
        upper: Upper bounds, (C,), possibly inf; equal bounds make an equality constraint.
    """

    names: tuple[str, ...]
    lower: Array
    upper: Array

    @abstractmethod
    def values(self, x: Array) -> Array:
        """Returns the values (C,) of the rows at x (m,)."""

    @abstractmethod
    def jacobian(self, x: Array) -> Array:
        """Returns the Jacobian (C, m) of the rows at x (m,)."""

    @abstractmethod
    def curvature(self, x: Array, multipliers: Array) -> Array:
        """Returns the Hessian (m, m) at x (m,) of the sum of multipliers (C,) times rows."""

    def violations(self, x: Array) -> Array:
        """Returns each row's distance (C,) beyond its bounds, zero within."""
        values = self.values(x)
        beyond = np.maximum(self.lower - values, values - self.upper)
        return np.asarray(np.maximum(beyond, 0.0))


@dataclass(frozen=True)
class Multipliers:
    """Lagrange multipliers: the decrease in energy when a bound is relaxed by one.

    Attributes:
        bounds: Multipliers of the variables' bounds, (m,), negative at lower bounds.
        constraints: Multipliers of the constraints, (C,).
    """

    bounds: Array
    constraints: Array


class Problem(ABC):
    """A function to minimise.

    Attributes:
        start: Initial point within the bounds, (m,).
        lower: Lower bounds, (m,), possibly -inf.
        upper: Upper bounds, (m,), possibly inf.
        multipliers: Multipliers of a similar problem's solution, for a warm start.
    """

    start: Array
    lower: Array
    upper: Array
    multipliers: Multipliers | None = None

    @abstractmethod
    def value_and_gradient(self, x: Array) -> tuple[float, Array]:
        """Returns the value at x (m,) and its gradient (m,)."""

    def normal_equations(self, x: Array) -> tuple[float, Array, Array] | None:
        """Returns the value, the gradient (m,) and a positive semi-definite curvature (m, m).

        None if the problem has no such matrix.
        """
        return None

    def without_curvature(self) -> tuple[str, ...]:
        """Returns the names of the parts without such a matrix; empty if all have one."""
        return () if self.normal_equations(self.start) else ("the problem",)

    def constraints(self) -> Constraints | None:
        """Returns constraints for solvers that support them; None without any."""
        return None

    def projected(self, x: Array) -> Array:
        """Returns the projection of x (m,) onto all limits, by default those of the box."""
        return np.clip(x, self.lower, self.upper)


@dataclass(frozen=True)
class Solution:
    """The result of a solver.

    Attributes:
        x: The best evaluated point, (m,), within the bounds.
        value: Value at x, never greater than at the start.
        converged: Whether a tolerance was met; false at the maximum number of iterations, or if the
            solver failed to progress.
        iterations: Number of steps.
        evaluations: Number of calls of ``value_and_gradient``.
        message: Reason why the solver ended.
        multipliers: Multipliers at x, if the solver computes them.
        gradient: Gradient at x, (m,), if the solver returns it.
        curvature: Gauss-Newton matrix at x, (m, m), if the solver returns it.
    """

    x: Array
    value: float
    converged: bool
    iterations: int
    evaluations: int
    message: str
    multipliers: Multipliers | None = None
    gradient: Array | None = None
    curvature: Array | None = None


@dataclass(frozen=True)
class LimitKeeping:
    """A solver's treatment of joint limits, in a few words each.

    Couplings are satisfied by every solver, because a coupled hinge has no coordinate.

    Attributes:
        hinges: Treatment of the limits of hinges.
        balls: Treatment of the swing and twist limits of ball joints.
        hard: Whether every solution satisfies all limits.
    """

    hinges: str
    balls: str
    hard: bool


class Solver(Plugin, ABC):
    """A minimiser of problems."""

    group = "regkit.solvers"

    limits: ClassVar[LimitKeeping] = LimitKeeping(
        hinges="bounds", balls="not kept; the term `limits` penalises", hard=False
    )
    """Treatment of joint limits; every solver satisfies bounds."""

    minimizes_plans: ClassVar[bool] = False
    """Whether it minimises a problem that is compiled as a whole, in single precision."""

    @classmethod
    def keeping_limits(cls) -> list[str]:
        """Returns the installed solvers that satisfy all joint limits; skips broken ones."""
        able = []
        for kind in cls.available():
            try:
                able += [kind] if cls.load(kind).limits.hard else []
            except PluginError:
                continue
        return able

    @abstractmethod
    def minimize(self, problem: Problem) -> Solution:
        """Returns a point with a value no greater than at the start.

        Raises:
            DataError: If the value at the start is not finite.
        """
