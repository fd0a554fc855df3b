"""IPOPT, an interior-point method, from CasADi: it holds all joint limits as constraints."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import Field, field_validator

from regkit.interfaces import LimitKeeping, Multipliers, Problem, Solution, Solver
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.optional import load_library
from regkit_plugins.solvers.ipopt.callbacks import Callbacks
from regkit_plugins.solvers.ipopt.options import ALWAYS, ENDS, QUASI_NEWTON, QUIET, WARM, check
from regkit_plugins.solvers.ipopt.program import Program
from regkit_plugins.solvers.ipopt.watch import SETTLED, Watch

SAME = 1e-6
"""Values that differ by less, in units of the mean curvature, are of the same minimum."""

Tolerance = Annotated[float, Field(gt=0.0)]


class Ipopt(Solver):
    """IPOPT: joint limits are constraints, held exactly, and the value is least within them.

    Hinges are bounded, swings and twists of ball joints are smooth constraints. Values are scaled
    by their mean curvature, so that a tolerance of the gradient is about a step.
    """

    kind: Literal["ipopt"] = "ipopt"
    limits: ClassVar[LimitKeeping] = LimitKeeping(
        hinges="bounds", balls="smooth constraints", hard=True
    )

    max_iterations: Annotated[int, Field(ge=1)] = 100
    """Steps at most."""
    gradient_tolerance: Tolerance = 1e-8
    """Stop when the force that is left would move the pose by no more than this against the mean
    curvature [rad, m]; with a kernel without curvature, against the value at the start."""
    value_tolerance: Annotated[float, Field(ge=0.0)] = 1e-5
    """Stop when a step lowers the value by less than this part of what has been gained so far."""
    constraint_tolerance: Tolerance = 1e-8
    """By how much a limit may be violated at the end [rad]."""
    max_seconds: Tolerance | None = None
    """Time for one solution at most [s]; then the best point so far within the limits is taken."""
    reach: Tolerance = 1.0
    """How far a variable without bounds may move in one solution: the root [m], a hinge without
    limits [rad], the numbers of a quaternion."""
    options: dict[str, bool | int | float | str] = Field(default_factory=dict)
    """Further options of IPOPT, by its own names."""

    @field_validator("options")
    @classmethod
    def _options_are_known(cls, options: dict[str, Any]) -> dict[str, Any]:
        check(options)
        return options

    def minimize(self, problem: Problem) -> Solution:
        """The best point within the limits; it is no worse than the start brought within them.

        Raises:
            DataError: If the value or gradient at the start is not finite, no point was found that
                keeps the limits, or IPOPT itself failed.
        """
        program = Program(problem, self.constraint_tolerance, self.reach)
        if program.best is not None and not program.at(program.start)[1].any():
            value, start = program.best
            return Solution(start, value, True, 0, program.evaluations, "no force is left")
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
                f"IPOPT found no pose that keeps all limits ({message}): '{name}' is missed by "
                f"{violation:.3g}"
            )
        # The multipliers are those of the end.
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
        """IPOPT's options by its own names."""
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
    """The bounds of variables and constraints, and the multipliers with which to begin."""
    bounds = {"lbx": program.lower, "ubx": program.upper}
    if program.constraints is not None:
        bounds |= {"lbg": program.constraints.lower, "ubg": program.constraints.upper}
    if program.multipliers is not None:
        bounds["lam_x0"] = program.multipliers.bounds / program.scale
        bounds["lam_g0"] = program.multipliers.constraints / program.scale
    return bounds


def _ending(program: Program, watch: Watch, status: str, end: Array) -> tuple[bool, str]:
    """Whether the best point is a solution, and why IPOPT ended."""
    if status not in ENDS and not watch.ending:
        raise DataError(f"IPOPT could not solve the problem: it ended with {status}")
    converged, message = ENDS.get(status, (False, status))
    if watch.ending:
        converged, message = watch.ending == SETTLED, watch.ending
    if converged and not program.allowed(end):
        return False, "IPOPT ended beyond the limits"
    least = np.inf if program.best is None else program.best[0]
    if converged and program.at(end)[0] > least + SAME * program.scale:
        return False, "IPOPT ended at a worse point than the best one, which is taken"
    if converged and program.stuck(end):
        return False, "a variable moved as far as `reach` lets it"
    return converged, message
