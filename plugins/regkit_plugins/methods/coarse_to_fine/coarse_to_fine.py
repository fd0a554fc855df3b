"""The coarse-to-fine method for surfaces of many points, with ever narrower Gaussians."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from regkit.body import Body
from regkit.config.quantities import Tolerance
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

Part = Annotated[float, Field(ge=1e-3, le=1e3)]


class CoarseToFine(Method):
    """Registers a body's surface points to a cloud, from few wide Gaussians to many narrow ones.

    At each resolution both are downsampled to one point per voxel, and each point is a Gaussian
    some voxels wide. The solver minimises the energy, and neighbours are updated after each
    solution. The result is the start of the next resolution; the last one uses all points.
    """

    kind: Literal["coarse_to_fine"] = "coarse_to_fine"

    shape: ShapeModel
    """Shape model of the body's surface, cloud_gsog or cloud_sog; the method sets its width."""
    kernel: Kernel
    """Kernel that compares the shape model with the data."""
    solver: Solver
    """Solver that minimises the energy between two updates of the neighbours."""
    coarsest: Part = 0.1
    """Size of the first voxels, as a fraction of the body's size."""
    finest: Part = 1.0
    """Size of the last voxels, as a fraction of the spacing of neighbouring points."""
    resolutions: Annotated[int, Field(ge=1, le=50)] = 6
    """Number of resolutions, with voxel sizes in geometric progression."""
    width: Part = 2.0
    """Standard deviation of a pair of Gaussians along the surface, in voxels."""
    searches: Annotated[int, Field(ge=1, le=1000)] = 10
    """Maximum number of neighbour updates at each resolution."""
    motion_tolerance: Tolerance = 0.1
    """The next resolution begins when the root mean square motion of the body's points, in voxels,
    is at most this."""

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
        """Binds the method to a body, with Gaussians of its surface at every resolution.

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
class _LevelResult:
    """The result of one resolution: pose, energy, convergence, and effort."""

    pose: Pose
    energy: float
    inlier_probability: Array
    converged: bool
    iterations: int
    evaluations: int
    message: str


@dataclass(frozen=True)
class BoundCoarseToFine(Registrar):
    """``CoarseToFine`` bound to a body.

    Attributes:
        method: The method.
        body: The body.
        primitives: Gaussians of the body at the finest resolution.
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
        """Minimises the energy from the best candidate, resolution by resolution.

        A prior and a warm start have no effect, because the data determine every motion.
        """
        data = observations(observation, self.levels)
        pose = candidates[0]
        if len(candidates) > 1:
            pose = min(candidates, key=lambda one: self._energy(self.levels[0], data[0], one))
        stages = []
        for level, downsampled in zip(self.levels, data, strict=True):
            stages.append(self._minimized(level, downsampled, pose))
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
        """Returns the energy at the finest resolution, with the neighbours in the given pose."""
        data = observations(observation, self.levels[-1:])[-1]
        placed = self._placed(self.levels[-1], pose)
        similarity = self.method.kernel.bind(data, placed)
        return Evaluation(similarity(placed).energy, _known(similarity.inlier_probability(placed)))

    def _minimized(self, level: Resolution, data: Observation, pose: Pose) -> _LevelResult:
        """Returns the result of a resolution after updates of the neighbours until convergence."""
        iterations = evaluations = 0
        converged, message = False, f"no convergence in {self.method.searches} searches"
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
            motion = float(np.sqrt(((placed.centres - before.centres) ** 2).sum(axis=1).mean()))
            if motion <= self.method.motion_tolerance * level.voxel:
                converged, message = True, "the motion converged"
                break
        inliers = _known(similarity.inlier_probability(placed))
        return _LevelResult(
            pose, solution.value, inliers, converged, iterations, evaluations, message
        )

    def _placed(self, level: Resolution, pose: Pose) -> Placed[Gaussians]:
        return level.primitives.place(self.body.place(pose).transforms)

    def _energy(self, level: Resolution, data: Observation, pose: Pose) -> float:
        placed = self._placed(level, pose)
        return self.method.kernel.bind(data, placed)(placed).energy


def _known(inlier_probability: Array | None) -> Array:
    """Returns the inlier probability of each point; NaN if the kernel does not provide it."""
    return np.array([np.nan]) if inlier_probability is None else inlier_probability
