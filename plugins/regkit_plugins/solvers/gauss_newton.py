"""Gauss-Newton with Levenberg and Marquardt's damping, on the normal equations of a kernel."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from regkit.interfaces import LimitKeeping, Problem, Solution, Solver
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError

Tolerance = Annotated[float, Field(ge=0.0)]


class GaussNewton(Solver):
    """Damped Gauss-Newton; it keeps all joint limits, and takes no step that raises the value."""

    kind: Literal["gauss_newton"] = "gauss_newton"
    limits: ClassVar[LimitKeeping] = LimitKeeping(
        hinges="each step is projected", balls="each step is projected", hard=True
    )

    max_iterations: Annotated[int, Field(ge=1)] = 10
    """Steps at most, those counted that were refused."""
    value_tolerance: Tolerance = 1e-5
    """Stop when a step lowers the value by less than this part of what has been gained so far."""
    damping: Annotated[float, Field(gt=0.0)] = 1e-3
    """The first damping, as a part of the matrix's diagonal."""
    resting: Annotated[float, Field(ge=0.0)] = 1e-3
    """Curvature given to every variable, as a part of the mean one: what nothing observes rests."""

    def minimize(self, problem: Problem) -> Solution:
        """The last accepted point; it is no worse than the start brought within the limits."""
        x = problem.projected(problem.start)
        value, gradient, matrix = _equations(problem, x)
        if not (np.isfinite(value) and np.isfinite(gradient).all() and np.isfinite(matrix).all()):
            raise DataError(f"the energy ({value}) or its gradient at the start is not finite")
        first, damping, evaluations = value, self.damping, 1
        for iteration in range(self.max_iterations):
            free = _free(problem, x, gradient)
            if not gradient[free].any():
                return Solution(x, value, True, iteration, evaluations, "no force is left")
            step = np.zeros_like(x)
            system = matrix[np.ix_(free, free)]
            diagonal = np.diagonal(system)
            # The force's own size keeps the step finite where there is no curvature at all.
            strongest = float(np.abs(gradient[free]).max())
            extra = damping * (diagonal + strongest) + self.resting * float(diagonal.mean())
            step[free] = -np.linalg.solve(system + np.diag(extra), gradient[free])
            trial = problem.projected(x + step)
            trial_value, trial_gradient, trial_matrix = _equations(problem, trial)
            evaluations += 1
            gain = value - trial_value
            if gain > 0.0 and np.isfinite(trial_matrix).all():
                x, value, gradient, matrix = trial, trial_value, trial_gradient, trial_matrix
                damping = max(0.2 * damping, 1e-9)
                if gain <= self.value_tolerance * (first - value):
                    return Solution(x, value, True, iteration + 1, evaluations, "the value settled")
            elif damping > 1e9:
                return Solution(x, value, True, iteration, evaluations, "no step lowers the value")
            else:
                damping *= 10.0
        return Solution(
            x, value, False, self.max_iterations, evaluations, "max_iterations were taken"
        )


def _equations(problem: Problem, x: Array) -> tuple[float, Array, Array]:
    equations = problem.normal_equations(x)
    if equations is None:
        lacking = ", ".join(problem.without_curvature())
        raise ConfigError(
            f"gauss_newton needs curvature, which {lacking} does not give; take the solver lbfgs"
        )
    return equations


def _free(problem: Problem, x: Array, gradient: Array) -> NDArray[np.bool_]:
    """Which variables may move: all but those that their bound holds against the force, (m,)."""
    held = ((x <= problem.lower) & (gradient > 0.0)) | ((x >= problem.upper) & (gradient < 0.0))
    return ~held
