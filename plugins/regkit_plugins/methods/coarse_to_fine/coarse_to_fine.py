"""The method for surfaces of many points: a likelihood of ever narrower Gaussians."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from regkit.body import Body
from regkit.gaussians.cloud_shape import CloudShape
from regkit.interfaces import (
    Evaluation,
    Kernel,
    Method,
    Registrar,
    RegistrationResult,
    ShapeModel,
    Solver,
)
from regkit.observation import Observation
from regkit.primitives import Gaussians, Placed
from regkit.registration import RegistrationProblem, TangentCoordinates
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit_plugins.methods.coarse_to_fine.resolutions import Resolution, observations, resolutions

Part = Annotated[float, Field(gt=0.0)]


class CoarseToFine(Method):
    """A body's surface points against a cloud, from few wide Gaussians to many narrow ones.

    At each resolution both are downsampled to one point in a voxel, and each point is a Gaussian
    some voxels wide. The energy is made small there, the neighbours being searched anew after each
    solution, and the pose found begins the next resolution. The last one takes all points.
    """

    kind: Literal["coarse_to_fine"] = "coarse_to_fine"

    shape: ShapeModel
    """What stands for the body's surface: cloud_gsog or cloud_sog; its width is set here."""
    kernel: Kernel
    """What compares it with the data."""
    solver: Solver
    """What makes the energy small between two searches for neighbours."""
    coarsest: Part = 0.1
    """Side of the first voxels, as a part of the body's size."""
    finest: Part = 1.0
    """Side of the last voxels, as a part of the distance of neighbouring points."""
    resolutions: Annotated[int, Field(ge=1)] = 6
    """How many there are, their voxels shrinking evenly."""
    width: Part = 2.0
    """Standard deviation of a pair of Gaussians in the surface, in voxels."""
    searches: Annotated[int, Field(ge=1)] = 10
    """How often neighbours are searched at one resolution, at most."""
    motion_tolerance: Annotated[float, Field(ge=0.0)] = 0.1
    """Go on to the next resolution when the root mean square motion of the body's points, in
    voxels, is no more than this."""

    @model_validator(mode="after")
    def _parts_fit(self) -> CoarseToFine:
        if not isinstance(self.shape, CloudShape):
            raise ValueError(
                f"shape '{self.shape.kind}' has no width that could be changed; take cloud_gsog "
                "or cloud_sog"
            )
        self.kernel.check_shape(self.shape)
        return self

    def bind(self, body: Body) -> BoundCoarseToFine:
        """Make Gaussians of the body's surface at every resolution.

        Raises:
            ConfigError: If the body has no surface.
        """
        assert isinstance(self.shape, CloudShape)
        levels = resolutions(
            body,
            self.shape,
            coarsest=self.coarsest,
            finest=self.finest,
            count=self.resolutions,
            width=self.width,
        )
        return BoundCoarseToFine(self, body, levels[-1].primitives, levels)


@dataclass(frozen=True)
class _Settled:
    """Where a resolution ended: the pose, its energy, whether it came to rest, and the effort."""

    pose: Pose
    energy: float
    inlier_probability: Array
    converged: bool
    iterations: int
    evaluations: int
    message: str


@dataclass(frozen=True)
class BoundCoarseToFine(Registrar):
    """``CoarseToFine`` for one body.

    Attributes:
        method: Its configuration.
        body: The body.
        primitives: Its Gaussians at the finest resolution.
        levels: The resolutions, the coarsest first.
    """

    method: CoarseToFine
    body: Body
    primitives: Gaussians
    levels: tuple[Resolution, ...]

    def register(
        self,
        observation: Observation,
        candidates: Sequence[Pose],
        *,
        prior: Pose | None = None,
        warm_start: RegistrationResult | None = None,
    ) -> RegistrationResult:
        """Returns the pose of least energy, from resolution to resolution, from the best candidate.

        Neither a prior nor a warm start changes the result, for the data determine every motion.
        """
        data = observations(observation, self.levels)
        pose = candidates[0]
        if len(candidates) > 1:
            pose = min(candidates, key=lambda one: self._energy(self.levels[0], data[0], one))
        stages = []
        for level, downsampled in zip(self.levels, data, strict=True):
            stages.append(self._settled(level, downsampled, pose))
            pose = stages[-1].pose
        last = stages[-1]
        return RegistrationResult(
            pose=pose,
            energy=last.energy,
            inlier_share=Evaluation(last.energy, last.inlier_probability).inlier_share,
            converged=last.converged,
            iterations=sum(stage.iterations for stage in stages),
            evaluations=sum(stage.evaluations for stage in stages),
            message=last.message,
        )

    def evaluate(self, observation: Observation, pose: Pose) -> Evaluation:
        """Returns the energy at the finest resolution, with the neighbours that a pose has."""
        data = observations(observation, self.levels[-1:])[-1]
        placed = self._placed(self.levels[-1], pose)
        similarity = self.method.kernel.bind(data, placed)
        return Evaluation(similarity(placed).energy, _known(similarity.inlier_probability(placed)))

    def _settled(self, level: Resolution, data: Observation, pose: Pose) -> _Settled:
        """Returns the pose at which a resolution comes to rest, neighbours being searched again."""
        iterations = evaluations = 0
        converged, message = False, f"it still moves after {self.method.searches} searches"
        placed = self._placed(level, pose)
        for _ in range(self.method.searches):
            similarity = self.method.kernel.bind(data, placed)
            coordinates = TangentCoordinates(self.body.skeleton, pose)
            problem = RegistrationProblem(coordinates, level.primitives, {"kernel": similarity})
            solution = self.method.solver.minimize(problem)
            pose = coordinates.pose(solution.x)
            iterations += solution.iterations
            evaluations += solution.evaluations
            before, placed = placed, self._placed(level, pose)
            moved = float(np.sqrt(((placed.centres - before.centres) ** 2).sum(axis=1).mean()))
            if moved <= self.method.motion_tolerance * level.voxel:
                converged, message = True, "the body came to rest"
                break
        inliers = _known(similarity.inlier_probability(placed))
        return _Settled(pose, solution.value, inliers, converged, iterations, evaluations, message)

    def _placed(self, level: Resolution, pose: Pose) -> Placed[Gaussians]:
        return level.primitives.place(self.body.place(pose).transforms)

    def _energy(self, level: Resolution, data: Observation, pose: Pose) -> float:
        placed = self._placed(level, pose)
        return self.method.kernel.bind(data, placed)(placed).energy


def _known(inlier_probability: Array | None) -> Array:
    """Returns the inlier probability of each point; NaN where the kernel cannot tell."""
    return np.array([np.nan]) if inlier_probability is None else inlier_probability
