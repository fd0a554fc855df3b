"""Easy, hard and broken functions for solvers to minimize."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from regkit.interfaces import Problem
from regkit.system.arrays import Array

Function = Callable[[Array], tuple[float, Array]]
"""Returns value and gradient (m,) at x (m,)."""

SCALES = np.array([1.0, 10.0, 0.3, 4.0])
TARGET = np.array([0.5, -1.0, 2.0, 0.1])
"""Minimum of ``bowl``."""


class Watched(Problem):
    """A function on a box that records its evaluations.

    Attributes:
        asked: The evaluated points, in order.
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
        """Returns value and gradient of the function."""
        self.asked.append(np.array(x))
        return self._function(x)

    def normal_equations(self, x: Array) -> tuple[float, Array, Array]:
        """Returns the Hessian by differences, with its negative curvature removed."""
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
    """A quadratic, rotated out of the coordinate axes."""
    mix = np.eye(4) + 0.3 * np.ones((4, 4))
    offset = mix @ (x - TARGET)
    return float(0.5 * offset @ (SCALES * offset)), mix.T @ (SCALES * offset)


def rosenbrock(x: Array) -> tuple[float, Array]:
    """The curved valley, with its minimum at (1, 1)."""
    a, b = x
    value = (1.0 - a) ** 2 + 100.0 * (b - a * a) ** 2
    slope = [-2.0 * (1.0 - a) - 400.0 * a * (b - a * a), 200.0 * (b - a * a)]
    return float(value), np.array(slope)


def broken_away(x: Array) -> tuple[float, Array]:
    """A function whose value and gradient are NaN outside a neighbourhood of the start."""
    value, gradient = bowl(x)
    if np.linalg.norm(x) > 0.05:
        return np.nan, np.full(len(x), np.nan)
    return value, gradient


def wrong_gradient(x: Array) -> tuple[float, Array]:
    """A bowl whose gradient points downhill."""
    value, gradient = bowl(x)
    return value, -gradient


def bumpy(x: Array) -> tuple[float, Array]:
    """A function with many local minima, and a gradient that ignores the small ones."""
    value, gradient = bowl(x)
    return value + 3.0 * float(np.sin(40.0 * x).sum()), gradient


def cliff(x: Array) -> tuple[float, Array]:
    """The bowl near the start, infinite beyond."""
    value, gradient = bowl(x)
    return (np.inf if x[0] > 0.2 else value), gradient


def constant(x: Array) -> tuple[float, Array]:
    """A constant, without any force."""
    return -1.5, np.zeros(len(x))


HARD: tuple[Function, ...] = (bowl, broken_away, wrong_gradient, bumpy, cliff, constant)
"""Functions on which a solver must not return a worse value than the start's."""
