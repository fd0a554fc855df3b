"""Laws of terms, for every shape that they accept."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, cast

import numpy as np
import pytest

from regkit.body import Body
from regkit.interfaces import (
    JointEnergy,
    Prior,
    Response,
    Scene,
    Similarity,
    Term,
    VisibilityWeights,
)
from regkit.interfaces.term import Effect
from regkit.primitives import Placed, Primitives
from regkit.registration import RegistrationProblem, TangentCoordinates
from regkit.system.errors import RegkitError
from regkit.testing.cases import Pair
from regkit.testing.compiled_laws import (
    alike,
    function_of,
    planned,
    require_same,
    require_same_equations,
)
from regkit.testing.differences import Slopes
from regkit.testing.laws import Laws, checked_on_every
from regkit.testing.samples import data_of, posed
from regkit.testing.shape_laws import attached
from regkit.testing.verdict import copied, require, same


class Nothing(Similarity):
    """An energy of zero, to test a term of the joints alone."""

    def __call__(self, placed: Placed[Any], *, curvature: bool = False) -> Response:
        """Returns zero energy and wrenches."""
        count = len(placed)
        return Response(0.0, np.zeros((count, 6)), np.zeros((count, 6, 6)) if curvature else None)


class TermLaws(Laws):
    """Laws of terms."""

    @pytest.fixture
    def scene(
        self, term_pair: Pair, body: Body, random: np.random.Generator
    ) -> tuple[Scene, Primitives]:
        """Returns a body whose parts intersect, with some joints beyond their limits."""
        term = cast(Term, term_pair.plugin)
        try:
            term.check(body)
        except RegkitError as error:
            pytest.skip(f"it does not accept the sample body: {error}")
        start = posed(body, random)
        bones = body.skeleton
        joints = np.arange(bones.dofs) >= (6 if bones.free else 0)
        start = bones.retract(start, 0.9 * joints * random.normal(size=bones.dofs))
        primitives = attached(term_pair.shape, body)
        primitives = replace(primitives, scales=2.0 * primitives.scales)
        placed = primitives.place(body.place(start).transforms)
        dofs = bones.dofs
        root = random.normal(size=(dofs, dofs))
        prior = Prior(start, root @ root.T, 2.0)
        return Scene(body, data_of(body, start, random), prior, placed), primitives

    @checked_on_every("option")
    def test_term_gradient_is_the_derivative_of_its_energy(
        self, term_pair: Pair, scene: tuple[Scene, Primitives], random: np.random.Generator
    ) -> None:
        """It agrees with central differences on the joints of a body."""
        effect = _effect(term_pair, scene)
        problem = _problem(effect, scene)
        x = 0.03 * random.normal(size=len(problem.start))
        slopes = Slopes.of(problem, x)
        require(
            slopes.agree() or slopes.largest < 1e-9, term_pair.plugin,
            slopes.message(scene[0].body), look_at=type(effect).__call__,
        )  # fmt: skip

    def test_term_curvature_is_symmetric_and_semidefinite(
        self, term_pair: Pair, scene: tuple[Scene, Primitives], random: np.random.Generator
    ) -> None:
        """Energy and gradient stay the same with it."""
        effect = _effect(term_pair, scene)
        problem = _problem(effect, scene)
        x = 0.03 * random.normal(size=len(problem.start))
        equations = problem.normal_equations(x)
        if equations is None:
            pytest.skip("it has no curvature")
        value, gradient = problem.value_and_gradient(x)
        again, slope, matrix = equations
        size = max(float(np.abs(matrix).max()), 1e-9)
        at = type(effect).__call__
        require(
            again == value and np.allclose(slope, gradient, rtol=1e-9, atol=1e-12 * size),
            term_pair.plugin, "returns another energy or gradient if curvature is requested",
            look_at=at,
        )  # fmt: skip
        uneven = np.abs(matrix - matrix.T).max() / size
        least = np.linalg.eigvalsh(0.5 * (matrix + matrix.T)).min() / size
        require(
            uneven < 1e-9 and least > -1e-9, term_pair.plugin, "has a curvature with asymmetry "
            f"{uneven:.2g} and eigenvalue {least:.2g}, relative to its largest entry; it "
            "must be symmetric and positive semi-definite", look_at=at,
        )  # fmt: skip

    def test_term_weighs_from_nothing_to_all_or_is_a_finite_energy(
        self, term_pair: Pair, scene: tuple[Scene, Primitives]
    ) -> None:
        """It returns one factor from 0 to 1 for each primitive, or a number."""
        term = cast(Term, term_pair.plugin)
        effect = term.bind(scene[0])
        require(
            isinstance(effect, VisibilityWeights) == term.weighs, term,
            f"returns {type(effect).__name__}, but declares weighs = {term.weighs}",
            look_at=type(term),
        )  # fmt: skip
        if not isinstance(effect, VisibilityWeights):
            problem = _problem(effect, scene)
            energy, _ = problem.value_and_gradient(problem.start)
            require(
                np.isfinite(energy), term, f"has the energy {energy} in an ordinary pose",
                look_at=type(effect).__call__,
            )  # fmt: skip
            return
        factors = effect.factors
        require(
            factors.shape == (len(scene[1]),) and ((factors >= 0.0) & (factors <= 1.0)).all(),
            term, f"returns factors from {factors.min():.2g} to {factors.max():.2g} of shape "
            f"{factors.shape}; they must be 0 to 1, {(len(scene[1]),)}", look_at=type(term).bind,
        )  # fmt: skip

    @checked_on_every("option")
    def test_compiled_term_is_the_readable_one(
        self, term_pair: Pair, scene: tuple[Scene, Primitives], random: np.random.Generator
    ) -> None:
        """Energy, gradient and matrix, or weights, agree to single precision."""
        term, (given, primitives) = cast(Term, term_pair.plugin), scene
        given = replace(given, observation=alike(given.observation))
        part = term.compiled(given.body, primitives)
        fast = planned(
            given.body,
            primitives,
            part,
            given.observation,
            given.prior.pose,
            prior=given.prior,
        )
        effect, look_at = term.bind(given), function_of(part)
        if isinstance(effect, VisibilityWeights):
            wanted = primitives.weights * effect.factors
            require_same(term, "weight", fast.scene.weights, wanted, look_at)
            return
        chart = TangentCoordinates(given.body.skeleton, given.prior.pose)
        x = 0.03 * random.normal(size=len(chart.origin()))
        problem = _problem(effect, (given, primitives))
        require_same_equations(term, problem, fast.problem(chart, None), x, look_at)

    def test_term_is_deterministic_and_changes_nothing(
        self, term_pair: Pair, scene: tuple[Scene, Primitives]
    ) -> None:
        """Bound twice, it returns the same, and it modifies no argument."""
        term, before = cast(Term, term_pair.plugin), copied(scene[0].placed)
        answers: list[tuple[object, ...]] = []
        for _ in range(2):
            effect = term.bind(scene[0])
            if isinstance(effect, VisibilityWeights):
                answers.append((effect.factors,))
            else:
                problem = _problem(effect, scene)
                answers.append(problem.value_and_gradient(problem.start))
        require(
            same(*answers), term, "returns another result when bound again",
            look_at=type(term).bind,
        )  # fmt: skip
        require(
            same(before, scene[0].placed), term, "modifies the primitives; copy arrays before "
            "writing to them", look_at=type(term).bind,
        )  # fmt: skip


def _effect(pair: Pair, scene: tuple[Scene, Primitives]) -> Similarity | JointEnergy:
    effect = cast(Term, pair.plugin).bind(scene[0])
    if isinstance(effect, VisibilityWeights):
        pytest.skip("it weights primitives and has no energy")
    return effect


def _problem(effect: Effect, scene: tuple[Scene, Primitives]) -> RegistrationProblem:
    chart = TangentCoordinates(scene[0].body.skeleton, scene[0].prior.pose)
    if isinstance(effect, JointEnergy):
        return RegistrationProblem(chart, scene[1], {"nothing": Nothing()}, [effect])
    assert isinstance(effect, Similarity)
    return RegistrationProblem(chart, scene[1], {"term": effect})
