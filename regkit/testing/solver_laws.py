"""Laws of solvers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from regkit.body import Body
from regkit.interfaces import Response, Similarity, Solver
from regkit.primitives import Placed, Primitives
from regkit.registration import COORDINATES, CoordinatesName, RegistrationProblem
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.testing.laws import Laws
from regkit.testing.problems import HARD, TARGET, Function, Watched, bowl, bumpy, constant
from regkit.testing.verdict import copied, require, same

BEYOND = 1e-6
"""Tolerance of a limit that is kept [rad], for rounding."""


@dataclass(frozen=True)
class Springs(Similarity):
    """Pulls each primitive to a point of its own.

    Attributes:
        places: The points (K, 3) [m].
    """

    places: Array

    def __call__(self, placed: Placed[Any], *, curvature: bool = False) -> Response:
        """Returns half the sum of squared distances."""
        offsets = placed.centres - self.places
        wrenches = np.concatenate([offsets, np.zeros_like(offsets)], axis=1)
        block = np.diag([1.0, 1.0, 1.0, 0.0, 0.0, 0.0])
        blocks = np.tile(block, (len(offsets), 1, 1)) if curvature else None
        return Response(float(0.5 * (offsets**2).sum()), wrenches, blocks)


class SolverLaws(Laws):
    """Laws of solvers."""

    @pytest.mark.parametrize("function", HARD, ids=lambda function: function.__name__)
    @pytest.mark.parametrize("box", [np.inf, 0.3, 0.0])
    def test_solver_stays_in_the_box_and_is_never_worse_than_the_start(
        self, solver: Solver, function: Function, box: float
    ) -> None:
        """Holds for every function."""
        problem, at = Watched(function, np.zeros(4), -box, box), type(solver).minimize
        first, _ = function(problem.start)
        solution = solver.minimize(problem)
        require(
            solution.value <= first, solver, f"returns {solution.value:.6g} for "
            f"{function.__name__}, worse than {first:.6g} at the start; keep the best point seen",
            look_at=at,
        )  # fmt: skip
        beyond = np.maximum(problem.lower - solution.x, solution.x - problem.upper).max()
        require(
            beyond <= 0.0, solver, f"leaves the box of {function.__name__} by {beyond:.2g}; clip x "
            "to lower and upper", look_at=at,
        )  # fmt: skip
        require(
            function(solution.x)[0] == solution.value, solver,
            f"returns the value {solution.value:.6g} of a point where {function.__name__} is "
            f"{function(solution.x)[0]:.6g}", look_at=at,
        )  # fmt: skip
        require(
            any(np.array_equal(solution.x, x) for x in problem.asked), solver,
            f"returns a point at which it never evaluated {function.__name__}",
            look_at=at,
        )  # fmt: skip
        require(
            bool(solution.message), solver, "does not say why it ended", look_at=at,
        )  # fmt: skip

    def test_solver_looks_only_within_the_box(self, solver: Solver) -> None:
        """A function need not be defined outside its bounds."""
        problem = Watched(bowl, np.zeros(4), [-0.1, -0.2, -np.inf, 0.0], [0.2, np.inf, 0.3, 0.0])
        solver.minimize(problem)
        asked = np.array(problem.asked)
        beyond = np.maximum(problem.lower - asked, asked - problem.upper).max()
        require(
            beyond <= 0.0, solver, f"evaluates points outside the bounds, by {beyond:.2g}",
            look_at=type(solver).minimize,
        )  # fmt: skip

    def test_solver_returns_the_best_point_that_it_saw(self, solver: Solver) -> None:
        """It also counts its evaluations correctly."""
        problem, at = Watched(bumpy, np.zeros(4)), type(solver).minimize
        solution = solver.minimize(problem)
        best = min(bumpy(x)[0] for x in problem.asked)
        require(
            solution.value == best, solver, f"saw the value {best:.6g} but returns "
            f"{solution.value:.6g}", look_at=at,
        )  # fmt: skip
        require(
            solution.evaluations == len(problem.asked), solver, f"reports {solution.evaluations} "
            f"evaluations of {len(problem.asked)}", look_at=at,
        )  # fmt: skip

    def test_solver_makes_a_quadratic_small(self, solver: Solver) -> None:
        """With its defaults, it reduces the value by more than half."""
        problem = Watched(bowl, np.zeros(4))
        solution, first = solver.minimize(problem), bowl(problem.start)[0]
        require(
            solution.value < 0.5 * first, solver, f"reduces a quadratic only from {first:.4g} to "
            f"{solution.value:.4g}", look_at=type(solver).minimize,
        )  # fmt: skip

    @pytest.mark.parametrize(
        ("function", "origin"), [(constant, [0.3, -0.2, 0.0, 1.0]), (bowl, TARGET)],
        ids=["no_force", "minimum"],
    )  # fmt: skip
    def test_solver_stays_at_a_minimum(
        self, solver: Solver, function: Function, origin: Array
    ) -> None:
        """Without a force there is no step."""
        solution = solver.minimize(Watched(function, origin))
        by = np.abs(solution.x - origin).max()
        require(
            by < 1e-9, solver, f"steps {by:.2g} away from a start without a force",
            look_at=type(solver).minimize,
        )  # fmt: skip

    def test_solver_changes_nothing_and_is_deterministic(self, solver: Solver) -> None:
        """Start and bounds stay unmodified, and repeated runs end at the same point."""
        problem, at = Watched(bowl, np.zeros(4), -0.5, 0.8), type(solver).minimize
        before = copied((problem.start, problem.lower, problem.upper))
        first, second = solver.minimize(problem), solver.minimize(problem)
        require(
            same(before, (problem.start, problem.lower, problem.upper)), solver,
            "modifies the problem's start or bounds; copy them", look_at=at,
        )  # fmt: skip
        require(
            same(first.x, second.x) and first.value == second.value, solver,
            "ends at another point when called again", look_at=at,
        )  # fmt: skip

    @pytest.mark.parametrize(
        ("value", "slope"), [(np.nan, 1.0), (np.inf, 1.0), (1.0, np.nan), (1.0, np.inf)]
    )
    def test_solver_refuses_a_start_that_is_not_finite(
        self, solver: Solver, value: float, slope: float
    ) -> None:
        """Raises ``DataError``, since the data are wrong."""
        refused = False
        try:
            solver.minimize(Watched(lambda x: (value, np.full(len(x), slope)), np.zeros(3)))
        except DataError:
            refused = True
        require(
            refused, solver, f"accepts a start with value {value} and slope {slope}; it must "
            "raise a DataError", look_at=type(solver).minimize,
        )  # fmt: skip

    @pytest.mark.parametrize("coordinates", COORDINATES)
    def test_solver_keeps_limits_as_it_declares(
        self, solver: Solver, body: Body, coordinates: CoordinatesName, random: np.random.Generator
    ) -> None:
        """Limits of hinges are bounds; those of ball joints must hold if declared hard."""
        bones, limits = body.skeleton, type(solver).limits
        chart = COORDINATES[coordinates](bones, bones.rest())
        count = len(bones.names)
        primitives = Primitives(
            segments=np.arange(count),
            centres=np.tile([0.1, 0.2, 0.1], (count, 1)),
            axes=np.tile(np.eye(3), (count, 1, 1)),
            scales=np.ones((count, 3)),
            weights=np.ones(count),
        )
        beyond = bones.retract(bones.rest(), 1.5 * random.normal(size=bones.dofs))
        goal = primitives.place(body.place(beyond).transforms).centres
        problem = RegistrationProblem(chart, primitives, {"springs": Springs(goal)})
        found = chart.pose(solver.minimize(problem).x)
        hinges = Pose(found.root, bones.rest().balls, found.hinges)
        at = type(solver).minimize
        by = bones.limits.violation(hinges).max(initial=0.0)
        require(
            by <= BEYOND, solver, f"exceeds the limits of hinges by {np.degrees(by):.2g} degrees; "
            "they are the problem's bounds", look_at=at,
        )  # fmt: skip
        by = bones.limits.violation(found).max(initial=0.0)
        require(
            by <= BEYOND or not limits.hard, solver, "declares hard limits but exceeds those of "
            f"ball joints by {np.degrees(by):.2g} degrees; keep problem.constraints(), or use "
            "problem.projected()", look_at=at,
        )  # fmt: skip
