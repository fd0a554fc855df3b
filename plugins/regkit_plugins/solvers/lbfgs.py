"""L-BFGS-B, the quasi-Newton method that the paper uses, from SciPy."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from regkit.interfaces import Problem, Solution, Solver
from regkit.system.arrays import Array
from regkit.system.errors import DataError

Tolerance = Annotated[float, Field(ge=0.0)]


class LBFGS(Solver):
    """SciPy's L-BFGS-B within bounds.

    Hinges keep their limits, which are bounds; the swing and twist limits of balls do not enter.
    """

    kind: Literal["lbfgs"] = "lbfgs"

    max_iterations: Annotated[int, Field(ge=1)] = 100
    """Steps at most."""
    value_tolerance: Tolerance = 1e-6
    """Stop when a step lowers the value by less than this part of it, or of that at the start."""
    gradient_tolerance: Tolerance = 1e-4
    """Stop when no part of the projected gradient exceeds this part of the value at the start."""
    memory: Annotated[int, Field(ge=1)] = 10
    """Pairs of steps and gradients that are remembered."""

    def minimize(self, problem: Problem) -> Solution:
        """The best point seen on SciPy's way down from the start."""
        # Imported when first used: SciPy's optimisers take longer to load than most commands to
        # run.
        from scipy.optimize import Bounds, minimize

        first, gradient = problem.value_and_gradient(problem.start)
        if not (np.isfinite(first) and np.isfinite(gradient).all()):
            raise DataError(f"the energy ({first}) or its gradient at the start is not finite")
        best = _Best(problem.start, first)
        if not gradient.any():
            return best.solution(
                converged=False, iterations=0, message="no force at the start: nothing overlaps"
            )
        # The value at the start sets the scale, so that tolerances mean the same for every kernel.
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
            # SciPy counts no iterations where the bounds leave nothing to move.
            iterations=int(result.get("nit", 0)),
            message=str(result.message),
        )


class _Best:
    """The best finite value so far, and how many were seen."""

    def __init__(self, x: Array, value: float) -> None:
        self.x, self.value, self.evaluations = x, value, 1

    def see(self, x: Array, value: float) -> None:
        self.evaluations += 1
        if value < self.value:
            self.x, self.value = x.copy(), value

    def solution(self, *, converged: bool, iterations: int, message: str) -> Solution:
        return Solution(self.x, self.value, converged, iterations, self.evaluations, message)
