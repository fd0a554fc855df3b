"""L-BFGS-B, the paper's quasi-Newton method, from SciPy."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from regkit.config.quantities import Iterations, Tolerance
from regkit.interfaces import Problem, Solution, Solver
from regkit.system.arrays import Array
from regkit.system.errors import DataError


class LBFGS(Solver):
    """SciPy's L-BFGS-B with bounds.

    It satisfies the limits of hinges as bounds; swing and twist limits of ball joints are ignored.
    """

    kind: Literal["lbfgs"] = "lbfgs"

    max_iterations: Iterations = 100
    """Maximum number of iterations."""
    value_tolerance: Tolerance = 1e-6
    """Converged if a step decreases the value by less than this fraction of its magnitude or of
    the start's."""
    gradient_tolerance: Tolerance = 1e-4
    """Converged if no component of the projected gradient exceeds this fraction of the value at
    the start."""
    memory: Annotated[int, Field(ge=1, le=1000)] = 10
    """Number of past steps and gradients that approximate the Hessian."""

    def minimize(self, problem: Problem) -> Solution:
        """Returns the best point that SciPy evaluates.

        Raises:
            DataError: If the value or gradient at the start is not finite.
        """
        # Imported on first use, because SciPy's optimisers load slowly.
        from scipy.optimize import Bounds, minimize

        first, gradient = problem.value_and_gradient(problem.start)
        if not (np.isfinite(first) and np.isfinite(gradient).all()):
            raise DataError(f"the energy ({first}) or its gradient at the start is not finite")
        best = _Best(problem.start, first)
        if not gradient.any():
            return best.solution(
                converged=False,
                iterations=0,
                message="zero gradient at the start: nothing overlaps",
            )
        # Scaling by the value at the start makes tolerances comparable between kernels.
        scale = abs(first) if first else float(np.abs(gradient).max())

        def scaled(x: Array) -> tuple[float, Array]:
            value, gradient = problem.value_and_gradient(x)
            best.see(x, value)
            return value / scale, gradient / scale

        result = minimize(
            scaled,
            problem.start,
            jac=True,
            method="L-BFGS-B",
            bounds=Bounds(problem.lower, problem.upper),
            options={
                "maxiter": self.max_iterations,
                "maxcor": self.memory,
                "ftol": self.value_tolerance,
                "gtol": self.gradient_tolerance,
            },
        )
        return best.solution(
            converged=bool(result.success),
            # SciPy reports no iterations if the bounds fix all variables.
            iterations=int(result.get("nit", 0)),
            message=str(result.message),
        )


class _Best:
    """The best finite value so far, and the number of evaluations."""

    def __init__(self, x: Array, value: float) -> None:
        self.x, self.value, self.evaluations = x, value, 1

    def see(self, x: Array, value: float) -> None:
        self.evaluations += 1
        if value < self.value:
            self.x, self.value = x.copy(), value

    def solution(self, *, converged: bool, iterations: int, message: str) -> Solution:
        return Solution(self.x, self.value, converged, iterations, self.evaluations, message)
