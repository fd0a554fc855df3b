"""The energy of one frame by compiled functions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from regkit.interfaces import JointEnergy, JointResponse, Multipliers, Prior
from regkit.interfaces.compiled import SceneArrays
from regkit.observation import Observation
from regkit.registration.compiled_plan import (
    PlanArrays,
    bind_to_best,
    derivatives,
    explained,
    kernel_energy,
)
from regkit.registration.compiled_problem import ProblemArrays
from regkit.registration.coordinates import Coordinates
from regkit.registration.energy import FrameEnergy
from regkit.registration.plan import Plan
from regkit.registration.pose_problem import PoseProblem
from regkit.registration.tangent import TangentCoordinates
from regkit.skeleton import Pose
from regkit.skeleton.arrays import PoseArrays
from regkit.system.arrays import Array


@dataclass(frozen=True, eq=False)
class PlannedEnergy(FrameEnergy):
    """A plan bound to a frame at a pose.

    Attributes:
        plan: The plan.
        parts: Its parts as compiled functions take them, with the tables of this frame.
        scene: The scene to which its parts are bound.
        prior: What is known of the pose before the frame.
        states: States of the parts.
    """

    plan: Plan
    parts: PlanArrays
    scene: SceneArrays
    prior: Prior
    states: Array

    @classmethod
    def of(
        cls,
        plan: Plan,
        observation: Observation,
        candidates: Sequence[Pose],
        prior: Prior,
        smoothing: float = 0.0,
    ) -> tuple[PlannedEnergy, Pose] | None:
        """Binds a plan to a frame at the best candidate; None if its points differ in variance.

        All candidates are compared with the kernel bound to the first one.

        Args:
            plan: The plan.
            observation: The frame's data.
            candidates: Poses, at least one.
            prior: What is known of the pose before the frame.
            smoothing: Standard deviation of a Gaussian that smooths the energy over space [m].

        Returns:
            The bound plan, and the candidate at which it is bound.
        """
        data, count = observation.arrays, len(plan.primitives.weights)
        if data is None:
            return None
        scene = SceneArrays(
            data,
            plan.primitives,
            np.empty(count),
            np.empty((count, 3)),
            np.empty((count, 3, 3)),
            float(smoothing),
        )
        states, parts = plan.states(), plan.arrays_of(observation)
        best = bind_to_best(
            parts,
            plan.body.skeleton.arrays,
            scene,
            np.array([pose.root for pose in candidates], dtype=np.float64),
            np.array([pose.balls for pose in candidates], dtype=np.float64),
            np.array([pose.hinges for pose in candidates], dtype=np.float64),
            states,
        )
        return cls(plan, parts, scene, prior, states), candidates[best]

    @property
    def weights(self) -> Array:
        """Weights of the primitives in this frame, with their visibility, (K,)."""
        return self.scene.weights

    def of_kernel(self, pose: Pose) -> float:
        """Returns the energy of the kernel alone in a pose."""
        skeleton = self.plan.body.skeleton.arrays
        return kernel_energy(self.parts, skeleton, self.scene, PoseArrays.of(pose), self.states)

    def total(self, pose: Pose) -> float:
        """Returns the energy of the kernel and all terms in a pose."""
        return self.derivatives(pose, 0)[0]

    def inlier_probability(self, pose: Pose) -> Array:
        """Returns the inlier probability of each point in a pose, (N,); NaN if it is unknown."""
        if not self.plan.explains:
            return np.array([np.nan])
        skeleton = self.plan.body.skeleton.arrays
        probability = np.empty(len(self.scene.data.points))
        explained(self.parts, skeleton, self.scene, PoseArrays.of(pose), self.states, probability)
        return probability

    def derivatives(self, pose: Pose, order: int) -> tuple[float, Array, Array]:
        """Returns energy, force (n,) and Gauss-Newton matrix (n, n), up to an order."""
        skeleton = self.plan.body.skeleton
        force, matrix = np.zeros(skeleton.dofs), np.zeros((skeleton.dofs, skeleton.dofs))
        energy = derivatives(
            self.parts,
            skeleton.arrays,
            self.scene,
            self.prior.arrays,
            PoseArrays.of(pose),
            self.states,
            order,
            force,
            matrix,
        )
        return energy, force, matrix

    def problem(self, coordinates: Coordinates, multipliers: Multipliers | None) -> CompiledProblem:
        """Returns the registration problem in given coordinates of the pose."""
        return CompiledProblem(self, coordinates, multipliers)


@dataclass(frozen=True, eq=False)
class PlannedJoints(JointEnergy):
    """The energies of the joints in a plan.

    Attributes:
        energy: The energies, bound to a prior.
    """

    energy: PlannedEnergy

    @classmethod
    def of(
        cls, plan: Plan, observation: Observation, scene: SceneArrays, prior: Prior
    ) -> tuple[PlannedJoints, ...]:
        """Returns the energy of the joints; none if the plan has no such part.

        Args:
            plan: The plan.
            observation: The frame's data in the world.
            scene: A scene with the plan's primitives.
            prior: What is known of the pose before the frame.
        """
        joints = plan.of_joints
        if joints is None:
            return ()
        parts = joints.arrays_of(observation)
        return (cls(PlannedEnergy(joints, parts, scene, prior, joints.states())),)

    def __call__(self, pose: Pose) -> JointResponse:
        """Returns the energy of a pose, its derivative and its curvature."""
        return JointResponse(*self.energy.derivatives(pose, 2))


class CompiledProblem(PoseProblem):
    """The registration problem of a plan.

    Args:
        energy: The plan, bound to a frame.
        coordinates: Coordinates around the start pose.
        multipliers: Multipliers of a similar problem's solution, for a warm start.
    """

    def __init__(
        self, energy: PlannedEnergy, coordinates: Coordinates, multipliers: Multipliers | None
    ) -> None:
        super().__init__(coordinates, multipliers)
        self._energy = energy

    def value_and_force(self, pose: Pose) -> tuple[float, Array]:
        """Returns the energy of a pose and its derivative to the degrees of freedom (n,)."""
        return self._energy.derivatives(pose, 1)[:2]

    def value_force_and_matrix(self, pose: Pose) -> tuple[float, Array, Array]:
        """Returns the energy, the force (n,) and the Gauss-Newton matrix (n, n)."""
        return self._energy.derivatives(pose, 2)

    @cached_property
    def arrays(self) -> ProblemArrays | None:
        """The problem as compiled solvers take it; None for other coordinates than steps."""
        if not isinstance(self._coordinates, TangentCoordinates):
            return None
        energy = self._energy
        return ProblemArrays(
            energy.parts,
            energy.plan.body.skeleton.arrays,
            energy.scene,
            energy.prior.arrays,
            PoseArrays.of(self._coordinates.start),
            energy.states,
            self.lower,
            self.upper,
        )
