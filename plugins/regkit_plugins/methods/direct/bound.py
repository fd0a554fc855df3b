"""``Direct`` bound to one body."""

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
    VisibilityWeights,
)
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.registration import COORDINATES
from regkit.skeleton import Pose
from regkit.system.errors import DataError
from regkit_plugins.methods.direct.energy import FrameEnergy

if TYPE_CHECKING:
    from regkit_plugins.methods.direct.direct import Direct

HARD = 1e-6
"""By how much a pose may be beyond a hard limit [rad]: what rounding makes."""


@dataclass(frozen=True)
class BoundDirect(Registrar):
    """``Direct`` for one body.

    Attributes:
        method: Its configuration.
        body: The body.
        primitives: Its shape model's primitives.
    """

    method: Direct
    body: Body
    primitives: Primitives

    def register(
        self,
        observation: Observation,
        candidates: Sequence[Pose],
        *,
        prior: Pose | None = None,
        warm_start: RegistrationResult | None = None,
    ) -> RegistrationResult:
        """The pose of least energy near the best candidate, from smooth to sharp."""
        annealing = self.method.annealing
        energy, pose = self._best(observation, candidates, prior, annealing[0])
        evaluations = len(candidates) if len(candidates) > 1 else 0
        iterations = 0
        multipliers = None if warm_start is None else warm_start.multipliers
        for index, smoothing in enumerate(annealing):
            if index:
                energy = self._bound(observation, pose, prior or candidates[0], smoothing)
            # Bounds are the limits only where the start is within them.
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
        prior: Pose | None,
        smoothing: float,
    ) -> tuple[FrameEnergy, Pose]:
        """The candidate of least energy, each bound at its own pose, and what it is bound to."""
        energies = [
            self._bound(observation, pose, prior or candidates[0], smoothing) for pose in candidates
        ]
        if len(candidates) == 1:
            return energies[0], candidates[0]
        pairs = zip(energies, candidates, strict=True)
        return min(pairs, key=lambda pair: pair[0].similarity(pair[1]))

    def _check_limits(self, pose: Pose) -> None:
        """Refuse what was promised not to happen.

        Raises:
            DataError: If the pose is beyond a limit.
        """
        violation = float(self.body.skeleton.limits.violation(pose).max(initial=0.0))
        if violation > HARD:
            raise DataError(
                f"solver '{self.method.solver.kind}' left the joint limits by "
                f"{np.degrees(violation):.3g} degrees, which hard_limits forbids"
            )

    def evaluate(self, observation: Observation, pose: Pose) -> Evaluation:
        """The energy in a pose, with everything bound to the frame there."""
        energy = self._bound(observation, pose, pose, 0.0)
        return Evaluation(energy.total(pose), energy.inlier_probability(pose))

    def _bound(
        self, observation: Observation, pose: Pose, prior: Pose, smoothing: float
    ) -> FrameEnergy:
        """The kernel and all terms bound to a frame at a pose."""
        placed = self.primitives.place(self.body.place(pose).transforms)
        scene = Scene(self.body, observation, prior, placed)
        effects = {
            f"terms[{index}] ({term.kind})": term.bind(scene)
            for index, term in enumerate(self.method.terms)
        }
        primitives = self.primitives
        for effect in effects.values():
            if isinstance(effect, VisibilityWeights):
                primitives = replace(primitives, weights=primitives.weights * effect.factors)
        placed = replace(placed, primitives=primitives)
        return FrameEnergy(
            self.body,
            primitives,
            self.method.kernel.bind(observation, placed, smoothing=smoothing),
            {name: one for name, one in effects.items() if isinstance(one, Similarity)},
            tuple(one for one in effects.values() if isinstance(one, JointEnergy)),
        )
