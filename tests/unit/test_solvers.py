"""What every solver promises, on functions that are easy, hard and broken."""

from collections.abc import Callable

import numpy as np
import pytest

from regkit.errors import DataError
from regkit.interfaces import Problem, Solver

Function = Callable[[np.ndarray], tuple[float, np.ndarray]]

LONG = {
    "lbfgs": {"max_iterations": 500, "value_tolerance": 1e-15, "gradient_tolerance": 1e-9},
    "gauss_newton": {"max_iterations": 500, "resting": 0.0, "value_tolerance": 1e-12},
    "ipopt": {"max_iterations": 500, "value_tolerance": 0.0, "reach": 10.0},
}
"""Options with which a solver gets to the bottom of a valley, where its own are not enough."""


class Known(Problem):
    """A function on a box, which remembers where it was asked."""

    def __init__(self, function: Function, start, lower=-np.inf, upper=np.inf) -> None:
        self.start = np.array(start, dtype=float)
        self.lower = np.broadcast_to(np.array(lower, dtype=float), self.start.shape)
        self.upper = np.broadcast_to(np.array(upper, dtype=float), self.start.shape)
        self.asked: list[np.ndarray] = []
        self._function = function

    def value_and_gradient(self, x: np.ndarray) -> tuple[float, np.ndarray]:
        self.asked.append(np.array(x))
        return self._function(x)

    def normal_equations(self, x: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
        """The Hessian by differences, its negative curvature taken away."""
        value, gradient = self.value_and_gradient(x)
        step = 1e-5
        with np.errstate(invalid="ignore"):
            columns = [
                (self._function(x + step * e)[1] - self._function(x - step * e)[1]) / (2 * step)
                for e in np.eye(len(x))
            ]
        hessian = np.array(columns) + np.array(columns).T
        if not np.isfinite(hessian).all():
            return value, gradient, np.full_like(hessian, np.nan)
        curvatures, axes = np.linalg.eigh(0.5 * hessian)
        return value, gradient, (axes * np.maximum(curvatures, 0.0)) @ axes.T


SCALES = np.array([1.0, 10.0, 0.3, 4.0])
TARGET = np.array([0.5, -1.0, 2.0, 0.1])


def bowl(x: np.ndarray) -> tuple[float, np.ndarray]:
    """A quadratic, tilted so that the axes are not its own."""
    mix = np.eye(4) + 0.3 * np.ones((4, 4))
    offset = mix @ (x - TARGET)
    return float(0.5 * offset @ (SCALES * offset)), mix.T @ (SCALES * offset)


def rosenbrock(x: np.ndarray) -> tuple[float, np.ndarray]:
    a, b = x
    value = (1.0 - a) ** 2 + 100.0 * (b - a * a) ** 2
    return value, np.array([
        -2.0 * (1.0 - a) - 400.0 * a * (b - a * a),
        200.0 * (b - a * a),
    ])  # fmt: skip


def broken_away(x: np.ndarray) -> tuple[float, np.ndarray]:
    """NaN, value and gradient, as soon as one leaves the start's neighbourhood."""
    value, gradient = bowl(x)
    if np.linalg.norm(x) > 0.05:
        return np.nan, np.full(len(x), np.nan)
    return value, gradient


def wrong_gradient(x: np.ndarray) -> tuple[float, np.ndarray]:
    value, gradient = bowl(x)
    return value, -gradient


def bumpy(x: np.ndarray) -> tuple[float, np.ndarray]:
    """Full of local minima, and a gradient that knows only the large ones."""
    value, gradient = bowl(x)
    return value + 3.0 * float(np.sin(40.0 * x).sum()), gradient


def cliff(x: np.ndarray) -> tuple[float, np.ndarray]:
    """The true bowl near the start, and infinite beyond."""
    value, gradient = bowl(x)
    return (np.inf if x[0] > 0.2 else value), gradient


def constant(x: np.ndarray) -> tuple[float, np.ndarray]:
    return -1.5, np.zeros(len(x))


@pytest.fixture(params=list(Solver.available()))
def kind(request: pytest.FixtureRequest) -> str:
    return request.param


@pytest.fixture
def solver(kind) -> Solver:
    return Solver.load(kind)()


@pytest.fixture
def patient(kind) -> Solver:
    return Solver.load(kind)(**LONG.get(kind, {}))


HARD = [bowl, broken_away, wrong_gradient, bumpy, cliff, constant]


@pytest.mark.parametrize("function", HARD, ids=lambda function: function.__name__)
@pytest.mark.parametrize("box", [np.inf, 0.3, 0.0])
def test_solution_is_in_the_box_and_no_worse_than_the_start(solver, function, box):
    problem = Known(function, np.zeros(4), -box, box)
    first, _ = function(problem.start)
    solution = solver.minimize(problem)
    assert solution.value <= first
    assert (problem.lower <= solution.x).all()
    assert (solution.x <= problem.upper).all()
    # The value is that of the point, which is one that the solver saw.
    assert function(solution.x)[0] == solution.value
    assert any(np.array_equal(solution.x, x) for x in problem.asked)
    assert isinstance(solution.converged, bool)
    assert solution.message


def test_solver_looks_only_within_the_box(solver):
    problem = Known(bowl, np.zeros(4), [-0.1, -0.2, -np.inf, 0.0], [0.2, np.inf, 0.3, 0.0])
    solver.minimize(problem)
    assert len(problem.asked) >= 2
    for x in problem.asked:
        assert (problem.lower <= x).all()
        assert (x <= problem.upper).all()


def test_solution_is_the_best_point_that_was_seen(solver):
    problem = Known(bumpy, np.zeros(4))
    solution = solver.minimize(problem)
    assert solution.value == min(bumpy(x)[0] for x in problem.asked)
    assert solution.evaluations == len(problem.asked)


def test_quadratic_is_solved(patient):
    solution = patient.minimize(Known(bowl, np.zeros(4)))
    assert solution.converged
    np.testing.assert_allclose(solution.x, TARGET, atol=1e-4)
    assert solution.value == pytest.approx(0.0, abs=1e-6)


def test_bounded_quadratic_has_no_force_into_the_box(patient):
    """First-order optimality: the gradient vanishes, or presses a variable on its bound."""
    problem = Known(bowl, np.zeros(4), [-1.0, -0.4, -1.0, -1.0], [1.0, 1.0, 0.5, 1.0])
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
        solver.minimize(Known(lambda x, unit=unit: scaled(x, unit), [-1.2, 1.0])).x
        for unit in (1e-6, 1.0, 1e6)
    ]
    np.testing.assert_allclose(ends[0], ends[1], atol=1e-5)
    np.testing.assert_allclose(ends[2], ends[1], atol=1e-5)


@pytest.mark.parametrize("start", [(-1.2, 1.0), (2.0, -1.0)])
def test_rosenbrock_is_solved(patient, start):
    solution = patient.minimize(Known(rosenbrock, start))
    np.testing.assert_allclose(solution.x, 1.0, atol=1e-3)
    assert solution.converged


def test_start_without_a_force_is_returned(solver):
    solution = solver.minimize(Known(constant, [0.3, -0.2, 0.0, 1.0]))
    np.testing.assert_array_equal(solution.x, [0.3, -0.2, 0.0, 1.0])
    assert solution.value == -1.5
    assert solution.iterations == 0


def test_start_at_the_minimum_stays_there(solver):
    solution = solver.minimize(Known(bowl, TARGET))
    np.testing.assert_allclose(solution.x, TARGET, atol=1e-9)


def test_start_is_not_written_to(solver):
    problem = Known(bowl, np.zeros(4))
    problem.start.flags.writeable = False
    assert solver.minimize(problem).value < bowl(np.zeros(4))[0]


@pytest.mark.parametrize(
    ("value", "slope"), [(np.nan, 1.0), (np.inf, 1.0), (1.0, np.nan), (1.0, np.inf)]
)
def test_start_that_is_not_finite_is_refused(solver, value, slope):
    problem = Known(lambda x: (value, np.full(len(x), slope)), np.zeros(3))
    with pytest.raises(DataError, match="at the start is not finite"):
        solver.minimize(problem)


def test_iterations_are_limited(kind):
    solver = Solver.load(kind)(max_iterations=3)
    solution = solver.minimize(Known(rosenbrock, [-1.2, 1.0]))
    assert solution.iterations <= 3
    assert not solution.converged
    assert solution.value < rosenbrock(np.array([-1.2, 1.0]))[0]
