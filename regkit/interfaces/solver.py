"""Solvers, and the problems that they solve: a smooth function on a box."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from regkit.arrays import Array
from regkit.plugin import Plugin


class Problem(ABC):
    """A function to be made small.

    Attributes:
        start: Where to begin, (m,); it lies within the bounds.
        lower: Lower bounds, (m,), possibly -inf.
        upper: Upper bounds, (m,), possibly inf.
    """

    start: Array
    lower: Array
    upper: Array

    @abstractmethod
    def value_and_gradient(self, x: Array) -> tuple[float, Array]:
        """The value at x (m,) and its gradient (m,)."""

    def normal_equations(self, x: Array) -> tuple[float, Array, Array] | None:
        """The value, the gradient (m,) and a positive semi-definite matrix (m, m) of curvature.

        None if the problem has no such matrix.
        """
        return None

    def projected(self, x: Array) -> Array:
        """The point nearest to x (m,) that keeps all limits; here, those of the box."""
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
    """

    x: Array
    value: float
    converged: bool
    iterations: int
    evaluations: int
    message: str


class Solver(Plugin, ABC):
    """Makes a problem's value small."""

    group = "regkit.solvers"

    @abstractmethod
    def minimize(self, problem: Problem) -> Solution:
        """A point that is no worse than the start.

        Raises:
            DataError: If the value at the start is not finite.
        """
