"""The direct method bound to a body."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from regkit.body import Body
from regkit.interfaces import (
    Evaluation,
    Prior,
    Registrar,
    RegistrationResult,
    Scene,
    Solution,
    Term,
)
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.registration import (
    COORDINATES,
    Coordinates,
    FrameEnergy,
    Plan,
    PlannedEnergy,
    PoseCurvature,
    SummedEnergy,
    TangentCoordinates,
    effective_points,
    thinned,
)
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError
from regkit_plugins.methods.direct.effects import Effects
from regkit_plugins.methods.direct.views import best_in_views

if TYPE_CHECKING:
    from regkit_plugins.methods.direct.direct import Direct

HARD = 1e-6
"""Maximum violation of a hard limit by rounding [rad]."""


@dataclass(frozen=True)
class BoundDirect(Registrar):
    """``Direct`` bound to a body.

    Attributes:
        method: The method.
        body: The body.
        primitives: Primitives of its shape model.
        plan: The same by compiled functions, if all parts offer them, and the solver takes them.
        derivatives: The same, whether or not the solver takes it.
    """

    method: Direct
    body: Body
    primitives: Primitives
    plan: Plan | None = None
    derivatives: Plan | None = None

    def register(
        self,
        observation: Observation,
        candidates: Sequence[Pose],
        *,
        prior: Prior | None = None,
        warm_start: RegistrationResult | None = None,
    ) -> RegistrationResult:
        """Minimises the energy near the best candidate, from smooth to sharp.

        Raises:
            DataError: If the pose violates a limit although ``hard_limits`` is set.
        """
        annealing = self.method.annealing
        prior = prior or Prior(candidates[0])
        energy, pose = self._best(observation, candidates, prior, annealing[0], self.plan)
        evaluations = len(candidates) if len(candidates) > 1 else 0
        iterations = 0
        multipliers = None if warm_start is None else warm_start.multipliers
        for index, smoothing in enumerate(annealing):
            if index:
                energy, _ = self._best(observation, [pose], prior, smoothing, self.plan)
            # A pose within the bounds is within the limits only if the start is.
            start = self.body.skeleton.limits.hinged(pose)
            coordinates = COORDINATES[self.method.coordinates](self.body.skeleton, start)
            solution = self.method.solver.minimize(energy.problem(coordinates, multipliers))
            pose, multipliers = coordinates.pose(solution.x), solution.multipliers
            iterations += solution.iterations
            evaluations += solution.evaluations
        if self.method.hard_limits:
            self._check_limits(pose)
        evaluation = Evaluation(solution.value, energy.inlier_probability(pose))
        return RegistrationResult(
            pose=pose,
            energy=evaluation.energy,
            inlier_share=evaluation.inlier_share,
            converged=solution.converged,
            iterations=iterations,
            evaluations=evaluations,
            message=solution.message,
            multipliers=multipliers,
            curvature=self._curvature(coordinates, pose, solution, prior, energy),
            effective_points=prior.points,
        )

    def _best(
        self,
        observation: Observation,
        candidates: Sequence[Pose],
        prior: Prior,
        smoothing: float,
        plan: Plan | None,
    ) -> tuple[FrameEnergy, Pose]:
        """Returns the energy bound to the candidate of least kernel energy, and that candidate.

        All candidates are compared with the kernel bound to the first one.
        """
        if observation.views:
            return best_in_views(self, observation, candidates, prior, smoothing, plan)
        if plan is not None:
            planned = PlannedEnergy.of(plan, observation, candidates, prior, smoothing)
            if planned is not None:
                return planned
        first = candidates[0]
        energy = self.summed(observation, first, prior, smoothing)
        if len(candidates) > 1:
            best = min(candidates, key=energy.of_kernel)
            if best is not first:
                return self.summed(observation, best, prior, smoothing), best
        return energy, first

    def _check_limits(self, pose: Pose) -> None:
        """Checks that the pose satisfies the hard limits.

        Raises:
            DataError: If the pose violates a limit.
        """
        violation = float(self.body.skeleton.limits.violation(pose).max(initial=0.0))
        if violation > HARD:
            raise DataError(
                f"solver '{self.method.solver.kind}' left the joint limits by "
                f"{np.degrees(violation):.3g} degrees, which hard_limits forbids"
            )

    def _curvature(
        self,
        coordinates: Coordinates,
        pose: Pose,
        solution: Solution,
        prior: Prior,
        energy: FrameEnergy,
    ) -> PoseCurvature | None:
        """Returns the curvature at a solution; None if the kernel or a term has none."""
        known = any(term.informed for term in self.method.terms) and prior.informed
        informed = prior if known else None
        shown = self._moving @ (energy.weights / self.primitives.weights)
        found = None
        if isinstance(coordinates, TangentCoordinates):
            found = PoseCurvature.of(coordinates, pose, solution, informed, shown)
        return found or PoseCurvature.at(self.body.skeleton, pose, energy, informed, shown)

    @cached_property
    def _moving(self) -> Array:
        """Share of each primitive among those that an independent dof moves, (m, K)."""
        skeleton = self.body.skeleton
        moved = skeleton.dof_mask[skeleton.independent_dofs][:, self.primitives.segments]
        return np.asarray(moved / np.maximum(moved.sum(axis=1, keepdims=True), 1.0))

    @property
    def reads_landmarks(self) -> bool:
        """Whether one of the terms looks at the landmarks of a frame."""
        return any(term.reads_landmarks for term in self.method.terms)

    def effective_points(self, observation: Observation, pose: Pose) -> float:
        """Returns the effective number of independent points; NaN if the kernel has no residuals.

        It is estimated from the correlation of some points' residuals.
        """
        return sum(
            self._effective_points(view.data, pose.moved(view.to_camera))
            for view in observation.each_view
        )

    def _effective_points(self, observation: Observation, pose: Pose) -> float:
        """Returns the effective number of independent points of one camera."""
        some = thinned(observation)
        weights = [term for term in self.method.terms if term.weighs]
        found = self.summed(some, pose, Prior(pose), 0.0, weights).whitened(pose)
        if found is None:
            return float("nan")
        return effective_points(some.points, *found, self.body.size, len(observation.points))

    def evaluate(self, observation: Observation, pose: Pose) -> Evaluation:
        """Returns the energy of a pose, with everything bound to the frame at this pose."""
        energy, _ = self._best(observation, [pose], Prior(pose), 0.0, self.plan)
        return Evaluation(energy.total(pose), energy.inlier_probability(pose))

    def gradient(self, observation: Observation, pose: Pose) -> Array:
        """Returns the derivative of the energy to a step of ``Skeleton.retract``, (n,)."""
        energy, _ = self._best(observation, [pose], Prior(pose), 0.0, self.derivatives)
        return energy.force(pose)

    def normal_equations(self, observation: Observation, pose: Pose) -> tuple[float, Array, Array]:
        """Returns the energy, its derivative (n,) and the Gauss-Newton matrix (n, n).

        Raises:
            ConfigError: If the kernel or a term has no curvature.
        """
        energy, _ = self._best(observation, [pose], Prior(pose), 0.0, self.derivatives)
        value, force, matrix = energy.derivatives(pose, 2)
        if matrix is None:
            lacking = ", ".join(energy.without_curvature())
            raise ConfigError(f"this needs curvature, which {lacking} does not provide")
        return value, force, matrix

    def scene(self, observation: Observation, pose: Pose, prior: Prior) -> Scene:
        """Returns the state to which terms are bound."""
        placed = self.primitives.place(self.body.place(pose).transforms)
        return Scene(self.body, observation, prior, placed)

    def summed(
        self,
        observation: Observation,
        pose: Pose,
        prior: Prior,
        smoothing: float,
        terms: Sequence[Term] | None = None,
    ) -> SummedEnergy:
        """Returns the sum of the kernel and terms, by default all, bound to a frame at a pose."""
        scene = self.scene(observation, pose, prior)
        effects = Effects.of(self.method.terms if terms is None else terms, self.primitives, scene)
        primitives = self.primitives
        if effects.weights is not primitives.weights:
            primitives = replace(primitives, weights=effects.weights)
        placed = replace(scene.placed, primitives=primitives)
        kernel = self.method.kernel.bind(observation, placed, smoothing=smoothing)
        return SummedEnergy(self.body, primitives, kernel, effects.terms, effects.joints)
