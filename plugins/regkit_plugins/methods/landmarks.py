"""The method of landmarks alone: marker-based solving."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np

from regkit.body import Body
from regkit.config.plugin import slot_default
from regkit.interfaces import (
    CompiledEnergy,
    CompiledJoints,
    CompiledPart,
    Evaluation,
    JointEnergy,
    Method,
    Prior,
    Registrar,
    RegistrationResult,
    Response,
    Scene,
    ShapeModel,
    Similarity,
    Solver,
    Term,
)
from regkit.interfaces.compiled import SceneArrays
from regkit.observation import Observation
from regkit.primitives import Placed, Primitives
from regkit.primitives.arrays import PrimitiveArrays
from regkit.registration import (
    FrameEnergy,
    Plan,
    PlannedEnergy,
    SummedEnergy,
    TangentCoordinates,
)
from regkit.skeleton import Pose
from regkit.system.compiled import compiled
from regkit.system.errors import ConfigError, DataError
from regkit.system.machine_types import Matrix, Stack, Vector


class LandmarkMethod(Method):
    """Minimises terms on the joints, without comparing points with the body's surface.

    With the term ``landmarks`` it solves for the pose from the markers of a motion-capture system,
    or from the keypoints of a detector.
    """

    kind: Literal["landmarks"] = "landmarks"

    terms: tuple[Term, ...]
    """Terms on the joints, such as ``landmarks``, ``continuity`` and ``limits``."""
    shape: ShapeModel
    """Shape model that pictures show; it takes no part."""
    solver: Solver = slot_default(Solver)
    """Solver that minimises the energy."""

    def shape_model(self) -> ShapeModel:
        """Returns the shape model of the pictures."""
        return self.shape

    def bind(self, body: Body) -> BoundLandmarks:
        """Binds the method to a body.

        Raises:
            RegkitError: If the shape model or a term does not support the body.
        """
        for term in self.terms:
            term.check(body)
        return BoundLandmarks(self, body, self.shape.bind(body))


@dataclass(frozen=True)
class BoundLandmarks(Registrar):
    """``LandmarkMethod`` bound to a body.

    Attributes:
        method: The method.
        body: The body.
        primitives: Primitives that pictures show.
    """

    method: LandmarkMethod
    body: Body
    primitives: Primitives

    @property
    def reads_landmarks(self) -> bool:
        """Whether the method looks at the landmarks of a frame: at nothing else."""
        return True

    def register(
        self,
        observation: Observation,
        candidates: Sequence[Pose],
        *,
        prior: Prior | None = None,
        warm_start: RegistrationResult | None = None,
    ) -> RegistrationResult:
        """Minimises the energy near the candidate of least energy.

        Raises:
            DataError: If the recording has no landmarks.
        """
        energy = self._energy(observation, candidates[0], prior or Prior(candidates[0]))
        start = min(candidates, key=energy.total) if len(candidates) > 1 else candidates[0]
        skeleton = self.body.skeleton
        coordinates = TangentCoordinates(skeleton, skeleton.limits.hinged(start))
        solution = self.method.solver.minimize(energy.problem(coordinates, None))
        return RegistrationResult(
            pose=coordinates.pose(solution.x),
            energy=solution.value,
            inlier_share=np.nan,
            converged=solution.converged,
            iterations=solution.iterations,
            evaluations=solution.evaluations,
            message=solution.message,
        )

    def evaluate(self, observation: Observation, pose: Pose) -> Evaluation:
        """Returns the energy of a pose; how well points are explained is unknown."""
        return Evaluation(
            self._energy(observation, pose, Prior(pose)).total(pose), np.array([np.nan])
        )

    @cached_property
    def _plan(self) -> Plan | None:
        """The terms by compiled functions, if all offer them."""
        offered = [term.compiled(self.body, self.primitives) for term in self.method.terms]
        parts: list[CompiledPart] = [one for one in offered if isinstance(one, CompiledJoints)]
        plain = type(self.primitives).place is Primitives.place
        if len(parts) < len(offered) or not plain or not self.method.solver.minimizes_plans:
            return None
        arrays = PrimitiveArrays.of(self.primitives)
        return Plan(self.body, arrays, (CompiledEnergy(nothing), *parts))

    def _energy(self, observation: Observation, pose: Pose, prior: Prior) -> FrameEnergy:
        """Returns the terms, bound to a frame.

        Raises:
            ConfigError: If a term is no energy of the joints.
            DataError: If the recording has no landmarks.
        """
        if observation.landmarks is None:
            raise DataError(
                "this frame has no landmarks, which the method 'landmarks' needs (keypoints of the "
                "recording, or the dataset 'markers')"
            )
        if self._plan is not None:
            planned = PlannedEnergy.of(self._plan, observation, [pose], prior)
            if planned is not None:
                return planned[0]
        placed = self.primitives.place(self.body.place(pose).transforms)
        scene = Scene(self.body, observation, prior, placed)
        joints = []
        for index, term in enumerate(self.method.terms):
            effect = term.bind(scene)
            if not isinstance(effect, JointEnergy):
                raise ConfigError(
                    f"term '{term.kind}' is no energy of the joints", place=f"method.terms[{index}]"
                )
            joints.append(effect)
        return SummedEnergy(self.body, self.primitives, Nothing(), {}, tuple(joints))


class Nothing(Similarity):
    """An energy of zero."""

    def __call__(self, placed: Placed[Any], *, curvature: bool = False) -> Response:
        """Returns zero energy and wrenches."""
        count = len(placed)
        return Response(0.0, np.zeros((count, 6)), np.zeros((count, 6, 6)) if curvature else None)


@compiled(python=False)
def nothing(
    scene: SceneArrays,
    centres: Matrix,
    axes: Stack,
    numbers: Vector,
    table: Matrix,
    state: Matrix,
    order: int,
    wrenches: Matrix,
    stiffness: Stack,
) -> float:
    """Returns an energy of zero."""
    return 0.0
