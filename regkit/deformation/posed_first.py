"""Methods that deform a body, bound to it: another method poses it first."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from regkit.body import Body
from regkit.clouds import voxel_downsampled, voxel_for
from regkit.interfaces import Evaluation, Prior, Registrar, RegistrationResult
from regkit.interfaces.result import LITTLE
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.skeleton import Pose
from regkit.system.arrays import Array

if TYPE_CHECKING:
    from regkit.deformation.deforming_method import DeformingMethod


@dataclass(frozen=True)
class PosedFirst(Registrar):
    """A ``DeformingMethod`` bound to a body.

    Attributes:
        body: The body.
        primitives: The primitives of the first method.
        method: The method.
        first: Its first method, bound to the body.
    """

    body: Body
    primitives: Primitives
    method: DeformingMethod
    first: Registrar

    @property
    def reads_landmarks(self) -> bool:
        """Whether the first method looks at the landmarks of a frame."""
        return self.first.reads_landmarks

    def register(
        self,
        observation: Observation,
        candidates: Sequence[Pose],
        *,
        prior: Prior | None = None,
        warm_start: RegistrationResult | None = None,
    ) -> RegistrationResult:
        """Poses the body by the first method, and deforms it."""
        posed = self.first.register(observation, candidates, prior=prior, warm_start=warm_start)
        return self._deformed(observation, posed)

    def register_each(
        self, observation: Observation, starts: Sequence[Pose], *, accuracy: float = np.inf
    ) -> list[RegistrationResult]:
        """Poses the body from each start, and deforms each result."""
        found = self.first.register_each(observation, starts, accuracy=accuracy)
        return [self._deformed(observation, posed) for posed in found]

    def evaluate(self, observation: Observation, pose: Pose) -> Evaluation:
        """Returns the quality of a pose by the first method, without a deformation."""
        return self.first.evaluate(observation, pose)

    def _deformed(self, observation: Observation, posed: RegistrationResult) -> RegistrationResult:
        """Returns a result with the deformation that moves the posed body onto the data."""
        assert self.body.surface is not None
        source = self.body.surface.place(self.body.place(posed.pose).transforms)
        count = self.method.points
        found = self.method.deformed(_some(source, count), _some(observation.points, count))
        return replace(
            posed,
            inlier_share=float((found.probability >= LITTLE).mean()),
            energy=found.energy,
            converged=posed.converged and found.converged,
            iterations=posed.iterations + found.iterations,
            message=f"{posed.message}; {found.message}",
            deformation=found.deformation,
        )


def _some(points: Array, count: int) -> Array:
    """Returns about ``count`` evenly spread points of a cloud (N, 3) [m]."""
    voxel = voxel_for(points, count)
    return np.asarray(points if voxel is None else voxel_downsampled(points, voxel))
