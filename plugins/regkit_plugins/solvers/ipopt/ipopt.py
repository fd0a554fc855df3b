"""IPOPT, an interior-point method, from CasADi, with all joint limits as constraints."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import Field, field_validator

from regkit.config.quantities import Factor, Iterations, Tolerance
from regkit.interfaces import LimitKeeping, Multipliers, Problem, Solution, Solver
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.optional import load_library
from regkit_plugins.solvers.ipopt.callbacks import Callbacks
from regkit_plugins.solvers.ipopt.options import ALWAYS, ENDS, QUASI_NEWTON, QUIET, WARM, check
from regkit_plugins.solvers.ipopt.program import Program
from regkit_plugins.solvers.ipopt.watch import SETTLED, Watch

SAME = 1e-6
"""Values that differ by less, in units of the mean curvature, belong to the same minimum."""

PositiveTolerance = Annotated[float, Field(gt=0.0, le=10.0)]


class Ipopt(Solver):
    """IPOPT, an interior-point method that satisfies all joint limits exactly.

    Hinge limits are bounds, swing and twist limits of ball joints are smooth constraints. Values
    are scaled by their mean curvature, so a gradient tolerance is approximately a step length.
    """

    kind: Literal["ipopt"] = "ipopt"
    limits: ClassVar[LimitKeeping] = LimitKeeping(
        hinges="bounds", balls="smooth constraints", hard=True
    )

    max_iterations: Iterations = 100
    """Maximum number of iterations."""
    gradient_tolerance: PositiveTolerance = 1e-8
    """Converged if the gradient divided by the mean curvature is at most this [rad, m]; for a
    kernel without curvature, the gradient is divided by the value at the start."""
    value_tolerance: Tolerance = 1e-5
    """Converged if a step decreases the value by less than this fraction of the total decrease."""
    constraint_tolerance: PositiveTolerance = 1e-8
    """Largest limit violation of a solution [rad]."""
    max_seconds: Annotated[float, Field(ge=1e-3, le=1e6)] | None = None
    """Maximum time per solution [s], after which the best point within the limits is returned."""
    reach: Factor = 1.0
    """Largest change of a variable without bounds in one solution: of the root [m], of a hinge
    without limits [rad], of the components of a quaternion."""
    options: dict[str, bool | int | float | str] = Field(default_factory=dict)
    """Further IPOPT options, by their IPOPT names."""

    @field_validator("options")
    @classmethod
    def _options_are_known(cls, options: dict[str, Any]) -> dict[str, Any]:
        check(options)
        return options

    def minimize(self, problem: Problem) -> Solution:
        """Returns the best point within the limits, never worse than the projected start.

        Raises:
            DataError: If the value or gradient at the start is not finite, no point within the
                limits is found, or IPOPT fails.
            DependencyError: If CasADi is missing.
        """
        program = Program(problem, self.constraint_tolerance, self.reach)
        if program.best is not None and not program.at(program.start)[1].any():
            value, start = program.best
            return Solution(start, value, True, 0, program.evaluations, "the gradient is zero")
        watch = Watch(program, self.value_tolerance, self.max_seconds)
        callbacks = Callbacks(program, watch)
        options = {**callbacks.derivatives, **QUIET, "ipopt": self._options(program)}
        solver = load_library("casadi").nlpsol("registration", "ipopt", callbacks.nlp, options)
        with callbacks.interruptible():
            result = solver(x0=program.start, **_bounds(program))
        if callbacks.failure is not None:
            raise callbacks.failure
        end, bounds, constraints = (
            np.array(result[name]).ravel() for name in ("x", "lam_x", "lam_g")
        )
        end = program.within(end)
        value = program.at(end)[0]
        stats = solver.stats()
        converged, message = _ending(program, watch, stats["return_status"], end)
        if program.best is None:
            violation, name = program.worst(end)
            raise DataError(
                f"IPOPT found no pose within all limits ({message}): '{name}' is violated by "
                f"{violation:.3g}"
            )
        # The multipliers belong to the last iterate.
        there = program.allowed(end) and value <= program.best[0] + SAME * program.scale
        return Solution(
            x=program.best[1],
            value=program.best[0],
            converged=converged,
            iterations=int(stats["iter_count"]),
            evaluations=program.evaluations,
            message=message,
            multipliers=Multipliers(program.scale * bounds, program.scale * constraints)
            if there
            else None,
        )

    def _options(self, program: Program) -> dict[str, Any]:
        """Returns the options by their IPOPT names."""
        return {
            **ALWAYS,
            "max_iter": self.max_iterations,
            "tol": self.gradient_tolerance,
            "constr_viol_tol": self.constraint_tolerance,
            **({} if program.multipliers is None else WARM),
            **({} if program.curved else QUASI_NEWTON),
            **self.options,
        }


def _bounds(program: Program) -> dict[str, Array]:
    """Returns the bounds of variables and constraints, and the initial multipliers."""
    bounds = {"lbx": program.lower, "ubx": program.upper}
    if program.constraints is not None:
        bounds |= {"lbg": program.constraints.lower, "ubg": program.constraints.upper}
    if program.multipliers is not None:
        bounds["lam_x0"] = program.multipliers.bounds / program.scale
        bounds["lam_g0"] = program.multipliers.constraints / program.scale
    return bounds


def _ending(program: Program, watch: Watch, status: str, end: Array) -> tuple[bool, str]:
    """Returns whether the best point is a solution, and the reason of termination."""
    if status not in ENDS and not watch.ending:
        raise DataError(f"IPOPT could not solve the problem: its status is {status}")
    converged, message = ENDS.get(status, (False, status))
    if watch.ending:
        converged, message = watch.ending == SETTLED, watch.ending
    if converged and not program.allowed(end):
        return False, "IPOPT ended beyond the limits"
    least = np.inf if program.best is None else program.best[0]
    if converged and program.at(end)[0] > least + SAME * program.scale:
        return False, "IPOPT ended at a worse point than the best one, which is returned"
    if converged and program.stuck(end):
        return False, "a variable moved as far as `reach` allows"
    return converged, message
