"""The energy of one frame: the kernel and all terms, bound to the data at one pose."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.interfaces import JointEnergy, Multipliers, Similarity
from regkit.primitives import Placed, Primitives
from regkit.registration.coordinates import Coordinates
from regkit.registration.pose_problem import PoseProblem
from regkit.registration.problem import RegistrationProblem
from regkit.registration.tangent import TangentCoordinates
from regkit.skeleton import Pose
from regkit.system.arrays import Array


class FrameEnergy(ABC):
    """The kernel and all terms, bound to a frame."""

    @property
    @abstractmethod
    def weights(self) -> Array:
        """Weights of the primitives in this frame, with their visibility, (K,)."""

    @abstractmethod
    def of_kernel(self, pose: Pose) -> float:
        """Returns the energy of the kernel alone in a pose."""

    @abstractmethod
    def total(self, pose: Pose) -> float:
        """Returns the energy of the kernel and all terms in a pose."""

    @abstractmethod
    def derivatives(self, pose: Pose, order: int) -> tuple[float, Array, Array | None]:
        """Returns energy, force (n,) and Gauss-Newton matrix (n, n) of a pose.

        Args:
            pose: The pose.
            order: 1 for the force, 2 for the matrix too; it is None if a part has none.
        """

    @abstractmethod
    def inlier_probability(self, pose: Pose) -> Array:
        """Returns the inlier probability of each point in a pose, (N,); NaN if it is unknown."""

    @abstractmethod
    def problem(self, coordinates: Coordinates, multipliers: Multipliers | None) -> PoseProblem:
        """Returns the registration problem in given coordinates of the pose."""

    def force(self, pose: Pose) -> Array:
        """Returns the derivative of the energy to a step of ``Skeleton.retract``, (n,)."""
        return self.derivatives(pose, 1)[1]

    def without_curvature(self) -> tuple[str, ...]:
        """Returns the names of the parts without Gauss-Newton blocks."""
        return ()


@dataclass(frozen=True)
class SummedEnergy(FrameEnergy):
    """The sum of a kernel and terms in their readable form.

    Attributes:
        body: The body.
        primitives: Primitives with their weights in this frame.
        kernel: The bound kernel.
        terms: The bound terms on primitives, by their places in the YAML.
        joints: The bound terms on joints.
    """

    body: Body
    primitives: Primitives
    kernel: Similarity
    terms: Mapping[str, Similarity]
    joints: tuple[JointEnergy, ...]

    @property
    def weights(self) -> Array:
        """Weights of the primitives in this frame, with their visibility, (K,)."""
        return self.primitives.weights

    def of_kernel(self, pose: Pose) -> float:
        """Returns the energy of the kernel alone in a pose."""
        return self.kernel.energy(self._placed(pose))

    def whitened(self, pose: Pose) -> tuple[Array, Array] | None:
        """Returns the kernel's whitened residuals (N, D) in a pose and shares (N,); or None."""
        return self.kernel.whitened(self._placed(pose))

    def total(self, pose: Pose) -> float:
        """Returns the energy of the kernel and all terms in a pose."""
        placed = self._placed(pose)
        energies = [one.energy(placed) for one in (self.kernel, *self.terms.values())]
        return sum(energies) + sum(joint(pose).energy for joint in self.joints)

    def inlier_probability(self, pose: Pose) -> Array:
        """Returns the inlier probability of each point in a pose, (N,); NaN if it is unknown."""
        probability = self.kernel.inlier_probability(self._placed(pose))
        return np.array([np.nan]) if probability is None else probability

    def problem(
        self, coordinates: Coordinates, multipliers: Multipliers | None
    ) -> RegistrationProblem:
        """Returns the registration problem in given coordinates of the pose."""
        return RegistrationProblem(
            coordinates,
            self.primitives,
            {"kernel": self.kernel, **self.terms},
            self.joints,
            multipliers,
        )

    def derivatives(self, pose: Pose, order: int) -> tuple[float, Array, Array | None]:
        """Returns energy, force (n,) and Gauss-Newton matrix (n, n), up to an order."""
        problem = self.problem(TangentCoordinates(self.body.skeleton, pose), None)
        found = problem.value_force_and_matrix(pose) if order == 2 else None
        return found or (*problem.value_and_force(pose), None)

    def without_curvature(self) -> tuple[str, ...]:
        """Returns the names of the kernel and terms without Gauss-Newton blocks."""
        rest = self.body.skeleton.rest()
        return self.problem(TangentCoordinates(self.body.skeleton, rest), None).without_curvature()

    def _placed(self, pose: Pose) -> Placed[Primitives]:
        return self.primitives.place(self.body.place(pose).transforms)
