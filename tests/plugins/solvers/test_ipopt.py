"""IPOPT holds constraints exactly, and ends well or with a clear word when it is made to fail."""

import os
import signal
import time

import numpy as np
import pytest
from pydantic import ValidationError

from regkit.interfaces import Constraints, Multipliers, Problem, Solver
from regkit.system.errors import DataError


class Rows(Constraints):
    """Linear rows and a half of the squared distance from the origin, to 1 at most."""

    def __init__(self, matrix, lower, upper, disc: bool = True) -> None:
        self.matrix = np.array(matrix, dtype=float)
        self.disc = disc
        self.lower, self.upper = np.array(lower, dtype=float), np.array(upper, dtype=float)
        if disc:
            self.lower, self.upper = np.append(self.lower, -np.inf), np.append(self.upper, 0.5)
        self.names = tuple(f"row {index}" for index in range(len(self.lower)))

    def values(self, x):
        return np.append(self.matrix @ x, [0.5 * x @ x] if self.disc else [])

    def jacobian(self, x):
        return np.vstack([self.matrix, [x] if self.disc else np.zeros((0, len(x)))])

    def curvature(self, x, multipliers):
        return (multipliers[-1] if self.disc else 0.0) * np.eye(len(x))


class Bowl(Problem):
    """``1/2 |x - (2, 1, 0)|^2`` within rows; it can be made to misbehave after some evaluations."""

    def __init__(self, rows: Constraints | None = None, misbehave=None, after: int = 2) -> None:
        self.start = np.array([0.0, 0.0, 0.5])
        self.lower, self.upper = np.full((2, 3), [[-np.inf], [np.inf]])
        self.target = np.array([2.0, 1.0, 0.0])
        self.rows, self.misbehave, self.after = rows, misbehave, after
        self.evaluations = 0

    def constraints(self):
        return self.rows

    def value_and_gradient(self, x):
        self.evaluations += 1
        value = 0.5 * float((x - self.target) @ (x - self.target))
        if self.misbehave is not None and self.evaluations > self.after:
            value = self.misbehave(value)
        return value, x - self.target

    def normal_equations(self, x):
        return *self.value_and_gradient(x), np.eye(3)


def ipopt(**options) -> Solver:
    return Solver.load("ipopt").model_validate({"kind": "ipopt", "reach": 10.0, **options})


def test_solution_is_the_nearest_point_within_a_disc():
    solution = ipopt(value_tolerance=0.0).minimize(Bowl(Rows(np.zeros((0, 3)), [], [])))
    expected = np.array([2.0, 1.0, 0.0]) / np.sqrt(5.0)
    np.testing.assert_allclose(solution.x, expected, atol=1e-6)
    assert solution.converged
    # The force that the disc holds: target - x = multiplier x.
    assert solution.multipliers.constraints[0] == pytest.approx(np.sqrt(5.0) - 1.0, abs=1e-5)


def test_equation_holds():
    rows = Rows([[1.0, 1.0, 1.0]], [0.3], [0.3])
    solution = ipopt(value_tolerance=0.0).minimize(Bowl(rows))
    assert solution.x.sum() == pytest.approx(0.3, abs=1e-8)
    assert rows.violations(solution.x).max() <= 1e-8
    assert solution.converged


def test_constraints_that_contradict_one_another_are_told():
    rows = Rows([[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [1.0, -np.inf], [np.inf, 0.5], disc=False)
    told = r"no pose within all limits \(.*infeasible\): 'row \d' is violated by"
    with pytest.raises(DataError, match=told):
        ipopt().minimize(Bowl(rows))


def test_equations_that_are_too_many_are_told():
    rows = Rows(np.ones((5, 3)), np.arange(5.0), np.arange(5.0), disc=False)
    with pytest.raises(DataError, match="there are more equations than variables"):
        ipopt().minimize(Bowl(rows))


def test_one_iteration_gives_the_best_point_within_the_limits():
    rows = Rows(np.zeros((0, 3)), [], [])
    problem = Bowl(rows)
    solution = ipopt(max_iterations=1).minimize(problem)
    assert not solution.converged
    assert solution.message == "max_iterations reached"
    assert solution.value <= Bowl().value_and_gradient(problem.start)[0]
    assert rows.violations(solution.x).max() <= 1e-8


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_value_that_is_not_finite_ends_at_the_best_point(value):
    solution = ipopt().minimize(Bowl(Rows(np.zeros((0, 3)), [], []), lambda _: value, after=3))
    assert np.isfinite(solution.value)
    assert not solution.converged
    assert solution.message


def test_what_a_problem_raises_comes_through():
    def fail(_: float) -> float:
        raise ZeroDivisionError("in the kernel")

    with pytest.raises(ZeroDivisionError, match="in the kernel"):
        ipopt().minimize(Bowl(misbehave=fail))


def test_interrupt_comes_through():
    def interrupt(value: float) -> float:
        os.kill(os.getpid(), signal.SIGINT)
        return value

    handler = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        ipopt().minimize(Bowl(misbehave=interrupt))
    assert signal.getsignal(signal.SIGINT) is handler


def test_time_runs_out_at_the_best_point_within_the_limits():
    def slow(value: float) -> float:
        time.sleep(0.05)
        return value

    class Projecting(Bowl):
        def projected(self, x):
            return x / max(1.0, np.linalg.norm(x))

    rows = Rows(np.zeros((0, 3)), [], [])
    problem = Projecting(rows, slow)
    begun = time.perf_counter()
    solution = ipopt(max_seconds=0.1, value_tolerance=0.0).minimize(problem)
    assert time.perf_counter() - begun < 5.0
    assert not solution.converged
    assert solution.message == "max_seconds reached"
    assert rows.violations(solution.x).max() <= 1e-8
    assert solution.value < Bowl().value_and_gradient(problem.start)[0]


def test_variable_that_reaches_too_far_is_told():
    solution = ipopt(reach=0.5).minimize(Bowl())
    assert not solution.converged
    assert "reach" in solution.message
    assert (np.abs(solution.x - Bowl().start) <= 0.5 + 1e-9).all()


def test_solution_without_curvature_is_found():
    class Plain(Bowl):
        def normal_equations(self, x):
            return None

    solution = ipopt(value_tolerance=0.0).minimize(Plain(Rows(np.zeros((0, 3)), [], [])))
    np.testing.assert_allclose(solution.x, [2 / 5**0.5, 1 / 5**0.5, 0.0], atol=1e-5)
    assert solution.converged


def test_multipliers_spare_iterations():
    rows = Rows(np.zeros((0, 3)), [], [])
    first = ipopt(value_tolerance=0.0).minimize(Bowl(rows))
    near = Bowl(rows)
    near.start = first.x + np.array([0.0, -0.01, 0.01])
    cold = ipopt(value_tolerance=0.0).minimize(near)
    near.multipliers = first.multipliers
    warm = ipopt(value_tolerance=0.0).minimize(near)
    assert warm.iterations < cold.iterations
    np.testing.assert_allclose(warm.x, cold.x, atol=1e-5)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"tol": 1e-3}, "'tol' is the field gradient_tolerance here"),
        ({"no_such": 1}, "'no_such: 1' is not taken by IPOPT: No such IPOPT option: no_such"),
        ({"mu_strategy": "adaptiv"}, '"adaptiv" is not a valid setting'),
        ({"mu_init": -1.0}, "is not a valid setting"),
        ({"mu_init": "much"}, "type mismatch"),
        ({"linear_solver": "ma57"}, "'linear_solver: ma57' is not taken by IPOPT: its status is"),
    ],
)
def test_options_that_ipopt_does_not_take_are_refused(options, message):
    with pytest.raises(ValidationError) as caught:
        ipopt(options=options)
    assert message in str(caught.value)


def test_options_of_ipopt_are_passed_on():
    assert ipopt(options={"mu_strategy": "monotone", "mu_init": 0.1}).minimize(Bowl()).converged


@pytest.mark.parametrize("entry", [np.nan, 0.0])
def test_multipliers_that_do_not_fit_are_left_out(entry):
    rows = Rows(np.zeros((0, 3)), [], [])
    expected = ipopt().minimize(Bowl(rows))
    problem = Bowl(rows)
    problem.multipliers = Multipliers(np.full(3 if np.isnan(entry) else 5, entry), np.zeros(1))
    np.testing.assert_array_equal(ipopt().minimize(problem).x, expected.x)
