"""IPOPT's options and return statuses."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import redirect_stdout
from io import StringIO

from regkit.system.optional import load_library
from regkit_plugins.solvers.ipopt.watch import LATE, SETTLED

Options = Mapping[str, bool | int | float | str]

FIELDS = {
    "max_iter": "max_iterations",
    "tol": "gradient_tolerance",
    "constr_viol_tol": "constraint_tolerance",
    "max_wall_time": "max_seconds",
    "max_cpu_time": "max_seconds",
}
"""IPOPT options that are fields of the plug-in."""

ALWAYS: Options = {
    "print_level": 0,
    "sb": "yes",
    # By default IPOPT relaxes bounds slightly.
    "bound_relax_factor": 0.0,
    # Suits starts far from and close to a solution; the monotone strategy always starts far inside.
    "mu_strategy": "adaptive",
}

WARM: Options = {
    "warm_start_init_point": "yes",
    "warm_start_bound_push": 1e-4,
    "warm_start_slack_bound_push": 1e-4,
    "warm_start_mult_bound_push": 1e-4,
}
"""Options for a warm start close to a solution, with its multipliers."""

QUASI_NEWTON: Options = {"hessian_approximation": "limited-memory"}
"""Options for a problem without curvature."""

QUIET = {"print_time": False, "show_eval_warnings": False, "no_nlp_grad": True}
"""CasADi options: no output, and no unneeded derivatives."""

ENDS = {
    "Solve_Succeeded": (True, "a tolerance was met"),
    "Solved_To_Acceptable_Level": (True, SETTLED),
    "Search_Direction_Becomes_Too_Small": (True, "no step decreases the value"),
    "Maximum_Iterations_Exceeded": (False, "max_iterations reached"),
    "Maximum_WallTime_Exceeded": (False, LATE),
    "Infeasible_Problem_Detected": (False, "the limits are locally infeasible"),
    "Not_Enough_Degrees_Of_Freedom": (False, "there are more equations than variables"),
    "Restoration_Failed": (False, "the restoration of feasibility failed"),
    "Diverging_Iterates": (False, "the iterates diverged"),
    "Invalid_Number_Detected": (False, "a value or derivative was not finite"),
    "Error_In_Step_Computation": (False, "no step could be computed"),
}
"""IPOPT's return statuses: whether it converged, and the reason of termination."""


def check(options: Options) -> None:
    """Validates options by passing each to IPOPT with a small problem.

    Raises:
        ValueError: If an option is a field of the plug-in, or IPOPT rejects it.
        DependencyError: If CasADi is missing.
    """
    for name in options:
        if name in FIELDS:
            raise ValueError(f"'{name}' is the field {FIELDS[name]} here")
    ca = load_library("casadi")
    x = ca.MX.sym("x")
    for name, value in options.items():
        printed = StringIO()
        try:
            # IPOPT prints errors in values, it does not raise them.
            with redirect_stdout(printed):
                trial = {"x": x, "f": x * x}
                solver = ca.nlpsol("trial", "ipopt", trial, {"ipopt": {name: value}, **QUIET})
                solver(x0=1.0)
            status = solver.stats()["return_status"]
            if status not in ENDS:
                raise RuntimeError(f"its status is {status}")
        except RuntimeError as error:
            said = [line for line in printed.getvalue().splitlines() if "valid" in line]
            lines = said or str(error).strip().splitlines()[-1:]
            # The message of an exception begins with its place in CasADi's source.
            reason = lines[0].split(".cpp:")[-1].lstrip("0123456789: ")
            raise ValueError(f"'{name}: {value}' is not taken by IPOPT: {reason}") from None
