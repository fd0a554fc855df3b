"""Functions that are easy, hard and broken, for solvers to make small."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from regkit.interfaces import Problem
from regkit.system.arrays import Array

Function = Callable[[Array], tuple[float, Array]]
"""A value and its gradient (m,) at x (m,)."""

SCALES = np.array([1.0, 10.0, 0.3, 4.0])
TARGET = np.array([0.5, -1.0, 2.0, 0.1])
"""Where ``bowl`` is least."""


class Watched(Problem):
    """A function on a box, which remembers where it was asked.

    Attributes:
        asked: The points, in their order.
    """

    def __init__(
        self,
        function: Function,
        start: ArrayLike,
        lower: ArrayLike = -np.inf,
        upper: ArrayLike = np.inf,
    ) -> None:
        self.start = np.array(start, dtype=float)
        self.lower = np.broadcast_to(np.array(lower, dtype=float), self.start.shape)
        self.upper = np.broadcast_to(np.array(upper, dtype=float), self.start.shape)
        self.asked: list[Array] = []
        self._function = function

    def value_and_gradient(self, x: Array) -> tuple[float, Array]:
        """What the function says."""
        self.asked.append(np.array(x))
        return self._function(x)

    def normal_equations(self, x: Array) -> tuple[float, Array, Array]:
        """The Hessian by differences, its negative curvature taken away."""
        value, gradient = self.value_and_gradient(x)
        step = 1e-5
        with np.errstate(invalid="ignore"):
            columns = [
                (self._function(x + step * e)[1] - self._function(x - step * e)[1]) / (2 * step)
                for e in np.eye(len(x))
            ]
        hessian = np.array(columns) + np.array(columns).T
        if not np.isfinite(hessian).all():
            return value, gradient, np.full_like(hessian, np.nan)
        curvatures, axes = np.linalg.eigh(0.5 * hessian)
        return value, gradient, (axes * np.maximum(curvatures, 0.0)) @ axes.T


def bowl(x: Array) -> tuple[float, Array]:
    """A quadratic, tilted so that the axes are not its own."""
    mix = np.eye(4) + 0.3 * np.ones((4, 4))
    offset = mix @ (x - TARGET)
    return float(0.5 * offset @ (SCALES * offset)), mix.T @ (SCALES * offset)


def rosenbrock(x: Array) -> tuple[float, Array]:
    """The curved valley, least at (1, 1)."""
    a, b = x
    value = (1.0 - a) ** 2 + 100.0 * (b - a * a) ** 2
    slope = [-2.0 * (1.0 - a) - 400.0 * a * (b - a * a), 200.0 * (b - a * a)]
    return float(value), np.array(slope)


def broken_away(x: Array) -> tuple[float, Array]:
    """NaN, value and gradient, as soon as one leaves the start's neighbourhood."""
    value, gradient = bowl(x)
    if np.linalg.norm(x) > 0.05:
        return np.nan, np.full(len(x), np.nan)
    return value, gradient


def wrong_gradient(x: Array) -> tuple[float, Array]:
    """A bowl whose gradient points downhill."""
    value, gradient = bowl(x)
    return value, -gradient


def bumpy(x: Array) -> tuple[float, Array]:
    """Full of local minima, and a gradient that knows only the large ones."""
    value, gradient = bowl(x)
    return value + 3.0 * float(np.sin(40.0 * x).sum()), gradient


def cliff(x: Array) -> tuple[float, Array]:
    """The true bowl near the start, and infinite beyond."""
    value, gradient = bowl(x)
    return (np.inf if x[0] > 0.2 else value), gradient


def constant(x: Array) -> tuple[float, Array]:
    """No force anywhere."""
    return -1.5, np.zeros(len(x))


HARD: tuple[Function, ...] = (bowl, broken_away, wrong_gradient, bumpy, cliff, constant)
"""What a solver must come back from with no worse than it was given."""
