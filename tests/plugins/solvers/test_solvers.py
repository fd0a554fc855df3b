"""How far solvers come; the laws that all of them keep are in ``tests/conformance``."""

import numpy as np
import pytest

from regkit.interfaces import Solver
from regkit.testing.problems import TARGET, Watched, bowl, constant, rosenbrock

LONG = {
    "lbfgs": {"max_iterations": 500, "value_tolerance": 1e-15, "gradient_tolerance": 1e-9},
    "gauss_newton": {"max_iterations": 500, "resting": 0.0, "value_tolerance": 1e-12},
    "ipopt": {"max_iterations": 500, "value_tolerance": 0.0, "reach": 10.0},
}
"""Options with which a solver gets to the bottom of a valley, where its own are not enough."""


@pytest.fixture(params=list(Solver.available()))
def kind(request: pytest.FixtureRequest) -> str:
    return request.param


@pytest.fixture
def solver(kind) -> Solver:
    return Solver.load(kind)()


@pytest.fixture
def patient(kind) -> Solver:
    return Solver.load(kind)(**LONG.get(kind, {}))


def test_quadratic_is_solved(patient):
    solution = patient.minimize(Watched(bowl, np.zeros(4)))
    assert solution.converged
    np.testing.assert_allclose(solution.x, TARGET, atol=1e-4)
    assert solution.value == pytest.approx(0.0, abs=1e-6)


def test_bounded_quadratic_has_no_force_into_the_box(patient):
    """First-order optimality: the gradient vanishes, or presses a variable on its bound."""
    problem = Watched(bowl, np.zeros(4), [-1.0, -0.4, -1.0, -1.0], [1.0, 1.0, 0.5, 1.0])
    solution = patient.minimize(problem)
    gradient = bowl(solution.x)[1]
    # An interior point comes as near to a bound as its tolerance lets it.
    at_upper, at_lower = solution.x > problem.upper - 1e-5, solution.x < problem.lower + 1e-5
    inside = ~(at_upper | at_lower)
    assert 0 < inside.sum() < 4
    np.testing.assert_allclose(gradient[inside], 0.0, atol=1e-3)
    assert (gradient[at_upper] <= 1e-6).all()
    assert (gradient[at_lower] >= -1e-6).all()


def test_solution_does_not_depend_on_the_unit_of_the_value(solver):
    """Tolerances are relative: a kernel's own units must not decide when to stop."""

    def scaled(x: np.ndarray, unit: float) -> tuple[float, np.ndarray]:
        value, gradient = rosenbrock(x)
        return unit * value, unit * gradient

    ends = [
        solver.minimize(Watched(lambda x, unit=unit: scaled(x, unit), [-1.2, 1.0])).x
        for unit in (1e-6, 1.0, 1e6)
    ]
    np.testing.assert_allclose(ends[0], ends[1], atol=1e-5)
    np.testing.assert_allclose(ends[2], ends[1], atol=1e-5)


@pytest.mark.parametrize("start", [(-1.2, 1.0), (2.0, -1.0)])
def test_rosenbrock_is_solved(patient, start):
    solution = patient.minimize(Watched(rosenbrock, start))
    np.testing.assert_allclose(solution.x, 1.0, atol=1e-3)
    assert solution.converged


def test_start_without_a_force_is_returned(solver):
    solution = solver.minimize(Watched(constant, [0.3, -0.2, 0.0, 1.0]))
    np.testing.assert_array_equal(solution.x, [0.3, -0.2, 0.0, 1.0])
    assert solution.value == -1.5
    assert solution.iterations == 0


def test_iterations_are_limited(kind):
    solver = Solver.load(kind)(max_iterations=3)
    solution = solver.minimize(Watched(rosenbrock, [-1.2, 1.0]))
    assert solution.iterations <= 3
    assert not solution.converged
    assert solution.value < rosenbrock(np.array([-1.2, 1.0]))[0]
