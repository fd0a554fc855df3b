"""The direct method bound to a body."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from regkit.body import Body
from regkit.interfaces import (
    Evaluation,
    JointEnergy,
    Registrar,
    RegistrationResult,
    Scene,
    Similarity,
    Term,
    VisibilityWeights,
)
from regkit.interfaces.term import Effect
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.registration import (
    COORDINATES,
    FrameEnergy,
    Plan,
    PlannedEnergy,
    SummedEnergy,
)
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError, PluginError
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
        prior: Pose | None = None,
        warm_start: RegistrationResult | None = None,
    ) -> RegistrationResult:
        """Minimises the energy near the best candidate, from smooth to sharp.

        Raises:
            DataError: If the pose violates a limit although ``hard_limits`` is set.
        """
        annealing = self.method.annealing
        prior = prior or candidates[0]
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
        )

    def _best(
        self,
        observation: Observation,
        candidates: Sequence[Pose],
        prior: Pose,
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

    def evaluate(self, observation: Observation, pose: Pose) -> Evaluation:
        """Returns the energy of a pose, with everything bound to the frame at this pose."""
        energy, _ = self._best(observation, [pose], pose, 0.0, self.plan)
        return Evaluation(energy.total(pose), energy.inlier_probability(pose))

    def gradient(self, observation: Observation, pose: Pose) -> Array:
        """Returns the derivative of the energy to a step of ``Skeleton.retract``, (n,)."""
        energy, _ = self._best(observation, [pose], pose, 0.0, self.derivatives)
        return energy.force(pose)

    def normal_equations(self, observation: Observation, pose: Pose) -> tuple[float, Array, Array]:
        """Returns the energy, its derivative (n,) and the Gauss-Newton matrix (n, n).

        Raises:
            ConfigError: If the kernel or a term has no curvature.
        """
        energy, _ = self._best(observation, [pose], pose, 0.0, self.derivatives)
        value, force, matrix = energy.derivatives(pose, 2)
        if matrix is None:
            lacking = ", ".join(energy.without_curvature())
            raise ConfigError(f"this needs curvature, which {lacking} does not provide")
        return value, force, matrix

    def scene(self, observation: Observation, pose: Pose, prior: Pose) -> Scene:
        """Returns the state to which terms are bound."""
        placed = self.primitives.place(self.body.place(pose).transforms)
        return Scene(self.body, observation, prior, placed)

    def summed(
        self, observation: Observation, pose: Pose, prior: Pose, smoothing: float
    ) -> SummedEnergy:
        """Returns the sum of the kernel and all terms, bound to a frame at a pose."""
        scene = self.scene(observation, pose, prior)
        effects = self.effects(scene)
        primitives = self.primitives
        if effects.weights is not primitives.weights:
            primitives = replace(primitives, weights=effects.weights)
        placed = replace(scene.placed, primitives=primitives)
        kernel = self.method.kernel.bind(observation, placed, smoothing=smoothing)
        return SummedEnergy(self.body, primitives, kernel, effects.terms, effects.joints)

    def effects(self, scene: Scene) -> Effects:
        """Returns the effects of all terms."""
        weights = self.primitives.weights
        terms: dict[str, Similarity] = {}
        joints: list[JointEnergy] = []
        for index, term in enumerate(self.method.terms):
            effect = term.bind(scene)
            if isinstance(effect, VisibilityWeights) is not term.weighs:
                raise _undeclared(term, effect)
            if isinstance(effect, VisibilityWeights):
                weights = weights * effect.factors
            elif isinstance(effect, JointEnergy):
                joints.append(effect)
            else:
                terms[f"terms[{index}] ({term.kind})"] = effect
        return Effects(weights, terms, tuple(joints))


@dataclass(frozen=True)
class Effects:
    """The effects of all terms.

    Attributes:
        weights: Weights of the primitives in this frame, (K,).
        terms: The bound terms on primitives, by their places in the YAML.
        joints: The bound terms on joints.
    """

    weights: Array
    terms: dict[str, Similarity]
    joints: tuple[JointEnergy, ...]


def _undeclared(term: Term, effect: Effect) -> PluginError:
    """Returns the error of a term whose effect is not the one that its class declares."""
    return PluginError(
        f"term '{term.kind}' returns {type(effect).__name__}, but its class declares "
        f"weighs = {term.weighs}; set it to {not term.weighs}"
    )
