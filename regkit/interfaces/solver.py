"""Solvers, and the problems that they solve: a smooth function on a box, within constraints."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from regkit.config.plugin import Plugin
from regkit.system.arrays import Array
from regkit.system.errors import PluginError


class Constraints(ABC):
    """Smooth functions of x, in C rows, that a solution keeps between bounds.

    Attributes:
        names: What each row limits, for messages, (C).
        lower: Lower bounds, (C,), possibly -inf.
        upper: Upper bounds, (C,), possibly inf; where both are equal, the row is an equation.
    """

    names: tuple[str, ...]
    lower: Array
    upper: Array

    @abstractmethod
    def values(self, x: Array) -> Array:
        """Returns the rows (C,) at x (m,)."""

    @abstractmethod
    def jacobian(self, x: Array) -> Array:
        """Their derivative (C, m)."""

    @abstractmethod
    def curvature(self, x: Array, multipliers: Array) -> Array:
        """Returns the second derivative (m, m) of the sum of multipliers (C,) times rows."""

    def violations(self, x: Array) -> Array:
        """How far each row (C,) is beyond its bounds, zero within."""
        values = self.values(x)
        beyond = np.maximum(self.lower - values, values - self.upper)
        return np.asarray(np.maximum(beyond, 0.0))


@dataclass(frozen=True)
class Multipliers:
    """How hard a solution is held: the energy gained where a bound gives way by one.

    Attributes:
        bounds: Of the variables' bounds, (m,), negative at a lower one.
        constraints: Of the constraints, (C,).
    """

    bounds: Array
    constraints: Array


class Problem(ABC):
    """A function to be made small.

    Attributes:
        start: Where to begin, (m,); it lies within the bounds.
        lower: Lower bounds, (m,), possibly -inf.
        upper: Upper bounds, (m,), possibly inf.
        multipliers: Those of the solution of a similar problem, with which a solver may begin.
    """

    start: Array
    lower: Array
    upper: Array
    multipliers: Multipliers | None = None

    @abstractmethod
    def value_and_gradient(self, x: Array) -> tuple[float, Array]:
        """Returns the value at x (m,) and its gradient (m,)."""

    def normal_equations(self, x: Array) -> tuple[float, Array, Array] | None:
        """The value, the gradient (m,) and a positive semi-definite matrix (m, m) of curvature.

        None if the problem has no such matrix.
        """
        return None

    def without_curvature(self) -> tuple[str, ...]:
        """What the problem has no such matrix for; empty if it has one."""
        return () if self.normal_equations(self.start) else ("the problem",)

    def constraints(self) -> Constraints | None:
        """What else a solution keeps, for solvers that can hold it; None if nothing."""
        return None

    def projected(self, x: Array) -> Array:
        """Returns the point nearest to x (m,) that keeps all limits; here, those of the box."""
        return np.clip(x, self.lower, self.upper)


@dataclass(frozen=True)
class Solution:
    """Where a solver ended.

    Attributes:
        x: The best point that it saw, (m,), within the bounds.
        value: The value there; never more than at the start.
        converged: Whether a tolerance was met; false if it ran out of iterations or could not go
            on.
        iterations: Steps taken.
        evaluations: Calls of ``value_and_gradient``.
        message: Why it ended.
        multipliers: How hard it is held there, if the solver knows.
    """

    x: Array
    value: float
    converged: bool
    iterations: int
    evaluations: int
    message: str
    multipliers: Multipliers | None = None


@dataclass(frozen=True)
class LimitKeeping:
    """What a solver does with joint limits, in a few words each.

    Couplings are no limits: what follows another joint has no coordinate, so every solver holds it.

    Attributes:
        hinges: How it keeps the limits of hinges.
        balls: How it keeps the swing and twist limits of ball joints.
        hard: Whether no solution is ever beyond any limit.
    """

    hinges: str
    balls: str
    hard: bool


class Solver(Plugin, ABC):
    """Makes a problem's value small."""

    group = "regkit.solvers"

    limits: ClassVar[LimitKeeping] = LimitKeeping(
        hinges="bounds", balls="not kept; the term `limits` penalises", hard=False
    )
    """What it does with joint limits; every solver keeps bounds."""

    @classmethod
    def keeping_limits(cls) -> list[str]:
        """The installed solvers that never leave a joint limit; a broken one is none of them."""
        able = []
        for kind in cls.available():
            try:
                able += [kind] if cls.load(kind).limits.hard else []
            except PluginError:
                continue
        return able

    @abstractmethod
    def minimize(self, problem: Problem) -> Solution:
        """A point that is no worse than the start.

        Raises:
            DataError: If the value at the start is not finite.
        """
