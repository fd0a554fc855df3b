"""IPOPT's own options, and what its statuses mean."""

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
"""Options of IPOPT's that are fields of the plug-in."""

ALWAYS: Options = {
    "print_level": 0,
    "sb": "yes",
    # Limits are limits: IPOPT would widen them a little.
    "bound_relax_factor": 0.0,
    # It finds its way from far and near; the monotone strategy would begin far inside each time.
    "mu_strategy": "adaptive",
}

WARM: Options = {
    "warm_start_init_point": "yes",
    "warm_start_bound_push": 1e-4,
    "warm_start_slack_bound_push": 1e-4,
    "warm_start_mult_bound_push": 1e-4,
}
"""To set out near a solution, from its multipliers."""

QUASI_NEWTON: Options = {"hessian_approximation": "limited-memory"}
"""Where nothing is known of the curvature."""

QUIET = {"print_time": False, "show_eval_warnings": False, "no_nlp_grad": True}
"""Options of CasADi's: print nothing, and ask for no derivative that is not needed."""

ENDS = {
    "Solve_Succeeded": (True, "a tolerance was met"),
    "Solved_To_Acceptable_Level": (True, SETTLED),
    "Search_Direction_Becomes_Too_Small": (True, "no step lowers the value"),
    "Maximum_Iterations_Exceeded": (False, "max_iterations were taken"),
    "Maximum_WallTime_Exceeded": (False, LATE),
    "Infeasible_Problem_Detected": (False, "no point near keeps all limits"),
    "Not_Enough_Degrees_Of_Freedom": (False, "there are more equations than variables"),
    "Restoration_Failed": (False, "no step leads on within the limits"),
    "Diverging_Iterates": (False, "the variables ran away"),
    "Invalid_Number_Detected": (False, "a value or derivative was not finite"),
    "Error_In_Step_Computation": (False, "no step could be computed"),
}
"""What IPOPT's statuses mean: whether it converged, and why it ended."""


def check(options: Options) -> None:
    """Let IPOPT itself look at options, by trying each on a small problem.

    Raises:
        ValueError: If one is a field here, or IPOPT does not take it.
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
            # What is wrong with a value is printed, not raised.
            with redirect_stdout(printed):
                trial = {"x": x, "f": x * x}
                solver = ca.nlpsol("trial", "ipopt", trial, {"ipopt": {name: value}, **QUIET})
                solver(x0=1.0)
            status = solver.stats()["return_status"]
            if status not in ENDS:
                raise RuntimeError(f"it ends with {status}")
        except RuntimeError as error:
            said = [line for line in printed.getvalue().splitlines() if "valid" in line]
            lines = said or str(error).strip().splitlines()[-1:]
            # What is raised begins with the place in CasADi's source.
            reason = lines[0].split(".cpp:")[-1].lstrip("0123456789: ")
            raise ValueError(f"'{name}: {value}' is not taken by IPOPT: {reason}") from None
