"""Gauss-Newton with Levenberg-Marquardt damping, on the normal equations of the problem."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from regkit.config.quantities import Iterations, Tolerance, Weight
from regkit.interfaces import LimitKeeping, Problem, Solution, Solver
from regkit.registration import CompiledProblem
from regkit.registration.compiled_problem import ProblemArrays
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError
from regkit_plugins.solvers.gauss_newton.compiled import ENDED, MESSAGES, NOT_FINITE, minimize


class GaussNewton(Solver):
    """Damped Gauss-Newton (Levenberg-Marquardt).

    It satisfies all joint limits by projection, and accepts only steps that decrease the value.
    """

    kind: Literal["gauss_newton"] = "gauss_newton"
    limits: ClassVar[LimitKeeping] = LimitKeeping(
        hinges="each step is projected", balls="each step is projected", hard=True
    )
    minimizes_plans: ClassVar[bool] = True

    max_iterations: Iterations = 10
    """Maximum number of steps, including rejected ones."""
    value_tolerance: Tolerance = 1e-5
    """Converged if a step decreases the value by less than this fraction of the total decrease."""
    damping: Weight = 1e-3
    """Initial damping, as a fraction of the matrix's diagonal."""
    resting: Annotated[float, Field(ge=0.0, le=1e12)] = 1e-3
    """Regularisation of all variables, as a fraction of the mean curvature; it keeps unobserved
    variables at rest."""

    def minimize(self, problem: Problem) -> Solution:
        """Returns the last accepted point, never worse than the start projected onto the limits.

        Raises:
            ConfigError: If the kernel or a term does not provide curvature.
            DataError: If the value, gradient or matrix at the start is not finite.
        """
        if isinstance(problem, CompiledProblem) and problem.arrays is not None:
            return self._minimized(problem, problem.arrays)
        x = problem.projected(problem.start)
        value, gradient, matrix = _equations(problem, x)
        if not (np.isfinite(value) and np.isfinite(gradient).all() and np.isfinite(matrix).all()):
            raise DataError(f"the energy ({value}) or its gradient at the start is not finite")
        first, damping, evaluations = value, self.damping, 1

        def ended(converged: bool, iterations: int, message: str) -> Solution:
            return Solution(
                x,
                value,
                converged,
                iterations,
                evaluations,
                message,
                gradient=gradient,
                curvature=matrix,
            )

        for iteration in range(self.max_iterations):
            free = _free(problem, x, gradient)
            if not gradient[free].any():
                return ended(True, iteration, "the gradient is zero")
            step = np.zeros_like(x)
            slope = gradient[free]
            system = matrix.copy() if free.all() else matrix[np.ix_(free, free)]
            diagonal = np.einsum("ii->i", system)
            # The magnitude of the gradient bounds the step where there is no curvature at all.
            strongest = float(np.abs(slope).max())
            diagonal += damping * (diagonal + strongest) + self.resting * float(
                diagonal.sum()
            ) / len(diagonal)
            step[free] = -np.linalg.solve(system, slope)
            trial = problem.projected(x + step)
            trial_value, trial_gradient, trial_matrix = _equations(problem, trial)
            evaluations += 1
            gain = value - trial_value
            if gain > 0.0 and np.isfinite(trial_matrix).all():
                x, value, gradient, matrix = trial, trial_value, trial_gradient, trial_matrix
                damping = max(0.2 * damping, 1e-9)
                if gain <= self.value_tolerance * (first - value):
                    return ended(True, iteration + 1, "the value converged")
            elif damping > 1e9:
                return ended(True, iteration, "no step decreases the value")
            else:
                damping *= 10.0
        return ended(False, self.max_iterations, "max_iterations reached")

    def _minimized(self, problem: CompiledProblem, arrays: ProblemArrays) -> Solution:
        """Returns the same point by compiled loops."""
        x = problem.start.copy()
        settings = (self.max_iterations, self.value_tolerance, self.damping, self.resting)
        gradient, matrix = np.empty(len(x)), np.empty((len(x), len(x)))
        value, iterations, evaluations, why = minimize(
            arrays, np.array(settings, float), x, gradient, matrix
        )
        if why == NOT_FINITE:
            raise DataError(f"the energy ({value}) or its gradient at the start is not finite")
        converged = why != ENDED
        return Solution(
            x,
            value,
            converged,
            iterations,
            evaluations,
            MESSAGES[why],
            gradient=gradient,
            curvature=matrix,
        )


def _equations(problem: Problem, x: Array) -> tuple[float, Array, Array]:
    equations = problem.normal_equations(x)
    if equations is None:
        lacking = ", ".join(problem.without_curvature())
        raise ConfigError(
            f"solver 'gauss_newton' needs curvature, which {lacking} does not provide; choose the "
            "solver 'lbfgs'"
        )
    return equations


def _free(problem: Problem, x: Array, gradient: Array) -> NDArray[np.bool_]:
    """Returns a mask (m,) of the variables that are not at an active bound."""
    held = ((x <= problem.lower) & (gradient > 0.0)) | ((x >= problem.upper) & (gradient < 0.0))
    return ~held
