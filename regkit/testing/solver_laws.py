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
"""By how much a pose may be beyond a limit that is kept [rad]: what rounding makes."""


@dataclass(frozen=True)
class Springs(Similarity):
    """Draws each primitive to a place of its own.

    Attributes:
        places: (K, 3) [m].
    """

    places: Array

    def __call__(self, placed: Placed[Any], *, curvature: bool = False) -> Response:
        """Half the squares of the distances."""
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
        """Whatever the function does to it."""
        problem, at = Watched(function, np.zeros(4), -box, box), type(solver).minimize
        first, _ = function(problem.start)
        solution = solver.minimize(problem)
        require(
            solution.value <= first, solver, f"came back from {function.__name__} with "
            f"{solution.value:.6g}, worse than {first:.6g} at the start; keep the best point seen",
            look_at=at,
        )  # fmt: skip
        beyond = np.maximum(problem.lower - solution.x, solution.x - problem.upper).max()
        require(
            beyond <= 0.0, solver, f"leaves the box of {function.__name__} by {beyond:.2g}; clip x "
            "to lower and upper", look_at=at,
        )  # fmt: skip
        require(
            function(solution.x)[0] == solution.value, solver,
            f"says {solution.value:.6g} of a point where {function.__name__} is "
            f"{function(solution.x)[0]:.6g}", look_at=at,
        )  # fmt: skip
        require(
            any(np.array_equal(solution.x, x) for x in problem.asked), solver,
            f"returns a point at which it never asked for the value of {function.__name__}",
            look_at=at,
        )  # fmt: skip
        require(
            bool(solution.message), solver, "does not say why it ended", look_at=at,
        )  # fmt: skip

    def test_solver_looks_only_within_the_box(self, solver: Solver) -> None:
        """A function need not exist beyond its bounds."""
        problem = Watched(bowl, np.zeros(4), [-0.1, -0.2, -np.inf, 0.0], [0.2, np.inf, 0.3, 0.0])
        solver.minimize(problem)
        asked = np.array(problem.asked)
        beyond = np.maximum(problem.lower - asked, asked - problem.upper).max()
        require(
            beyond <= 0.0, solver, f"asks for values beyond the bounds, by {beyond:.2g}",
            look_at=type(solver).minimize,
        )  # fmt: skip

    def test_solver_returns_the_best_point_that_it_saw(self, solver: Solver) -> None:
        """And counts how often it looked."""
        problem, at = Watched(bumpy, np.zeros(4)), type(solver).minimize
        solution = solver.minimize(problem)
        best = min(bumpy(x)[0] for x in problem.asked)
        require(
            solution.value == best, solver, f"saw the value {best:.6g} and returns "
            f"{solution.value:.6g}", look_at=at,
        )  # fmt: skip
        require(
            solution.evaluations == len(problem.asked), solver, f"counts {solution.evaluations} "
            f"evaluations of {len(problem.asked)}", look_at=at,
        )  # fmt: skip

    def test_solver_makes_a_quadratic_small(self, solver: Solver) -> None:
        """With its defaults it comes more than half the way down."""
        problem = Watched(bowl, np.zeros(4))
        solution, first = solver.minimize(problem), bowl(problem.start)[0]
        require(
            solution.value < 0.5 * first, solver, f"brings a quadratic from {first:.4g} to "
            f"{solution.value:.4g} only", look_at=type(solver).minimize,
        )  # fmt: skip

    @pytest.mark.parametrize(
        ("function", "start"), [(constant, [0.3, -0.2, 0.0, 1.0]), (bowl, TARGET)],
        ids=["no_force", "minimum"],
    )  # fmt: skip
    def test_solver_stays_at_a_minimum(
        self, solver: Solver, function: Function, start: Array
    ) -> None:
        """Where there is no force there is no step."""
        solution = solver.minimize(Watched(function, start))
        by = np.abs(solution.x - start).max()
        require(
            by < 1e-9, solver, f"steps {by:.2g} away from a start without a force",
            look_at=type(solver).minimize,
        )  # fmt: skip

    def test_solver_changes_nothing_and_is_deterministic(self, solver: Solver) -> None:
        """It writes neither to the start nor to the bounds, and ends twice in the same point."""
        problem, at = Watched(bowl, np.zeros(4), -0.5, 0.8), type(solver).minimize
        before = copied((problem.start, problem.lower, problem.upper))
        first, second = solver.minimize(problem), solver.minimize(problem)
        require(
            same(before, (problem.start, problem.lower, problem.upper)), solver,
            "writes to the problem's start or bounds; copy them", look_at=at,
        )  # fmt: skip
        require(
            same(first.x, second.x) and first.value == second.value, solver,
            "ends elsewhere when it is asked again", look_at=at,
        )  # fmt: skip

    @pytest.mark.parametrize(
        ("value", "slope"), [(np.nan, 1.0), (np.inf, 1.0), (1.0, np.nan), (1.0, np.inf)]
    )
    def test_solver_refuses_a_start_that_is_not_finite(
        self, solver: Solver, value: float, slope: float
    ) -> None:
        """With a ``DataError``, for the data are at fault."""
        refused = False
        try:
            solver.minimize(Watched(lambda x: (value, np.full(len(x), slope)), np.zeros(3)))
        except DataError:
            refused = True
        require(
            refused, solver, f"takes a start of the value {value} and the slope {slope}; it must "
            "raise a DataError", look_at=type(solver).minimize,
        )  # fmt: skip

    @pytest.mark.parametrize("coordinates", COORDINATES)
    def test_solver_keeps_limits_as_it_declares(
        self, solver: Solver, body: Body, coordinates: CoordinatesName, random: np.random.Generator
    ) -> None:
        """Hinges by their bounds; ball joints too, if it calls its limits hard."""
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
            by <= BEYOND, solver, f"leaves the limits of hinges by {np.degrees(by):.2g} degrees; "
            "they are the problem's bounds", look_at=at,
        )  # fmt: skip
        by = bones.limits.violation(found).max(initial=0.0)
        require(
            by <= BEYOND or not limits.hard, solver, "declares hard limits and leaves those of "
            f"ball joints by {np.degrees(by):.2g} degrees; keep problem.constraints(), or use "
            "problem.projected()", look_at=at,
        )  # fmt: skip
