"""The method that registers a body first, bound to a body."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from regkit.body import Body
from regkit.body.lifting import Lifting
from regkit.interfaces import Evaluation, Prior, Registrar, RegistrationResult
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.registration import lifted_curvature
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit_plugins.methods.body_first.fineness import Nearness, thinned_elsewhere

if TYPE_CHECKING:
    from regkit_plugins.methods.body_first.body_first import BodyFirst


@dataclass(frozen=True)
class BoundBodyFirst(Registrar):
    """``BodyFirst`` bound to a body.

    Attributes:
        settings: The settings.
        body: The composed body.
        primitives: Its primitives.
        lifting: What it has in common with its base.
        base: The method, bound to the base.
        whole: The method, bound to the composed body.
    """

    settings: BodyFirst
    body: Body
    primitives: Primitives
    lifting: Lifting
    base: Registrar
    whole: Registrar

    def register(
        self,
        observation: Observation,
        candidates: Sequence[Pose],
        *,
        prior: Prior | None = None,
        warm_start: RegistrationResult | None = None,
    ) -> RegistrationResult:
        """Registers the base, and then the whole if one of its parts has data."""
        prior = prior or Prior(candidates[0])
        lowered = [self.lifting.lowered(pose) for pose in candidates]
        coarse = thinned_elsewhere(observation, None, self.settings.coarse)
        first = self.base.register(coarse, lowered, prior=self._lowered(prior))
        pose = self.lifting.lifted(first.pose, candidates[0])
        near = [self._near(observation, one) for one in (candidates[0], pose)]
        if max(one.most for one in near) < self.settings.least_points:
            curvature = lifted_curvature(
                first.curvature, self.lifting, self.body.skeleton, pose, prior
            )
            return replace(first, pose=pose, curvature=curvature, multipliers=None)
        fine = thinned_elsewhere(observation, near[0].points | near[1].points, self.settings.coarse)
        return self.whole.register(fine, [*candidates, pose], prior=prior, warm_start=warm_start)

    def evaluate(self, observation: Observation, pose: Pose) -> Evaluation:
        """Returns the quality of a pose for all data, whatever its parts are near to."""
        return self.whole.evaluate(observation, pose)

    @property
    def reads_landmarks(self) -> bool:
        """Whether the method looks at the landmarks of a frame."""
        return self.whole.reads_landmarks

    def effective_points(self, observation: Observation, pose: Pose) -> float:
        """Returns the effective number of independent points of the data as they are registered."""
        near = self._near(observation, pose)
        mask = near.points if near.most >= self.settings.least_points else None
        return self.whole.effective_points(
            thinned_elsewhere(observation, mask, self.settings.coarse), pose
        )

    def gradient(self, observation: Observation, pose: Pose) -> Array:
        """Returns the derivative of the energy of all data to a step, (n,)."""
        return self.whole.gradient(observation, pose)

    def normal_equations(self, observation: Observation, pose: Pose) -> tuple[float, Array, Array]:
        """Returns the energy of all data, its derivative (n,) and the curvature (n, n)."""
        return self.whole.normal_equations(observation, pose)

    def _lowered(self, prior: Prior) -> Prior:
        """Returns what is known of the base, if its parts are where they are expected."""
        information, own = prior.information, self.lifting.dofs
        return Prior(
            self.lifting.lowered(prior.pose),
            None if information is None else information[np.ix_(own, own)],
            prior.points,
        )

    def _near(self, observation: Observation, pose: Pose) -> Nearness:
        return Nearness.of(self.body, pose, observation.points, self.settings.reach)
