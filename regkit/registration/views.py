"""The energy of several views: every camera sees the body in its own frame, and energies add."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from regkit.interfaces import JointEnergy, Multipliers
from regkit.registration.coordinates import Coordinates
from regkit.registration.energy import FrameEnergy
from regkit.registration.pose_problem import PoseProblem
from regkit.skeleton import Pose, Skeleton
from regkit.system.arrays import Array


@dataclass(frozen=True, eq=False)
class ViewEnergy:
    """The energy of one view.

    Attributes:
        energy: The kernel and the terms on primitives, bound to the view in the camera's frame.
        T_camera_world: Inverse of the camera's pose, (4, 4) [m].
        share: Share of the points that the view has.
    """

    energy: FrameEnergy
    T_camera_world: Array
    share: float

    def seen(self, pose: Pose) -> Pose:
        """Returns a pose in the world as the camera sees it."""
        return pose.moved(self.T_camera_world)


@dataclass(frozen=True, eq=False)
class ViewsEnergy(FrameEnergy):
    """The energies of all views by their share of the points, and those of the joints once.

    A step of ``Skeleton.retract`` moves the root in the world and turns it in its own frame, so
    only the derivatives to its translation differ from view to view.

    Attributes:
        skeleton: The skeleton.
        views: The energy of each view, without those of the joints.
        joints: The energies of the joints.
    """

    skeleton: Skeleton
    views: tuple[ViewEnergy, ...]
    joints: tuple[JointEnergy, ...]

    @property
    def weights(self) -> Array:
        """Weights of the primitives, (K,), each as in the view that sees it best."""
        return np.asarray(np.max([one.energy.weights for one in self.views], axis=0))

    def of_kernel(self, pose: Pose) -> float:
        """Returns the energy of the kernel alone in a pose."""
        return sum(one.share * one.energy.of_kernel(one.seen(pose)) for one in self.views)

    def total(self, pose: Pose) -> float:
        """Returns the energy of the kernel and all terms in a pose."""
        seen = sum(one.share * one.energy.total(one.seen(pose)) for one in self.views)
        return seen + sum(joint(pose).energy for joint in self.joints)

    def inlier_probability(self, pose: Pose) -> Array:
        """Returns the inlier probability of the points of all views, (N,); NaN if it is unknown."""
        found = [one.energy.inlier_probability(one.seen(pose)) for one in self.views]
        known = all(np.isfinite(one).all() for one in found)
        return np.concatenate(found) if known else np.array([np.nan])

    def derivatives(self, pose: Pose, order: int) -> tuple[float, Array, Array | None]:
        """Returns energy, force (n,) and Gauss-Newton matrix (n, n), up to an order."""
        dofs = self.skeleton.dofs
        energy, force = 0.0, np.zeros(dofs)
        matrix: Array | None = np.zeros((dofs, dofs))
        for one in self.views:
            own, own_force, own_matrix = one.energy.derivatives(one.seen(pose), order)
            energy += one.share * own
            if self.skeleton.free:
                own_force, own_matrix = _turned(one.T_camera_world, own_force, own_matrix)
            force += one.share * own_force
            matrix = _sum(matrix, None if own_matrix is None else one.share * own_matrix)
        for response in (joint(pose) for joint in self.joints):
            energy, force = energy + response.energy, force + response.force
            matrix = _sum(matrix, response.stiffness)
        return energy, force, matrix

    def without_curvature(self) -> tuple[str, ...]:
        """Returns the names of the parts without Gauss-Newton blocks."""
        parts: Sequence[FrameEnergy] = [one.energy for one in self.views]
        return tuple(dict.fromkeys(name for part in parts for name in part.without_curvature()))

    def problem(self, coordinates: Coordinates, multipliers: Multipliers | None) -> PoseProblem:
        """Returns the registration problem in given coordinates of the pose."""
        return ViewsProblem(self, coordinates, multipliers)


class ViewsProblem(PoseProblem):
    """The registration problem of several views.

    Args:
        energy: The energy of the views.
        coordinates: Coordinates around the start pose.
        multipliers: Multipliers of a similar problem's solution, for a warm start.
    """

    def __init__(
        self, energy: ViewsEnergy, coordinates: Coordinates, multipliers: Multipliers | None
    ) -> None:
        super().__init__(coordinates, multipliers)
        self._energy = energy

    def value_and_force(self, pose: Pose) -> tuple[float, Array]:
        """Returns the energy of a pose and its derivative to the degrees of freedom (n,)."""
        return self._energy.derivatives(pose, 1)[:2]

    def value_force_and_matrix(self, pose: Pose) -> tuple[float, Array, Array] | None:
        """Returns energy, force (n,) and Gauss-Newton matrix (n, n); None without a matrix."""
        energy, force, matrix = self._energy.derivatives(pose, 2)
        return None if matrix is None else (energy, force, matrix)

    def without_curvature(self) -> tuple[str, ...]:
        """Returns the names of the kernel and terms without Gauss-Newton blocks."""
        return self._energy.without_curvature()


def _turned(
    T_camera_world: Array, force: Array, matrix: Array | None
) -> tuple[Array, Array | None]:
    """Returns derivatives to the root's translation in the camera's axes as those in the world."""
    rotation = T_camera_world[:3, :3]
    force = force.copy()
    force[:3] = force[:3] @ rotation
    if matrix is not None:
        matrix = matrix.copy()
        matrix[:3] = rotation.T @ matrix[:3]
        matrix[:, :3] = matrix[:, :3] @ rotation
    return force, matrix


def _sum(one: Array | None, other: Array | None) -> Array | None:
    return None if one is None or other is None else one + other
