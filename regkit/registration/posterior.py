"""The curvature at a registered pose, and the covariance that follows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.interfaces import Curvature, Prior, Solution
from regkit.registration.compiled_posterior import (
    add_active_limits,
    contracted,
    expanded,
    inverted,
    to_tangent,
)
from regkit.registration.energy import FrameEnergy
from regkit.registration.tangent import TangentCoordinates
from regkit.skeleton import Pose, Skeleton
from regkit.skeleton.arrays import PoseArrays
from regkit.skeleton.compiled_difference import add_at_end
from regkit.system.arrays import Array


@dataclass(frozen=True, eq=False)
class PoseCurvature(Curvature):
    """The curvature of a frame's energy at the pose that minimises it.

    With the Gauss-Newton matrix H of the mean energy and N independent points, the information of
    the pose is N H + L, where L is that of the prior. Without a prior's information, L is that of
    poses spread evenly over the joint limits, which only matters where the data tell nothing.
    Couplings map the covariance of the independent degrees of freedom to all; an active limit has
    no variance beyond it.

    Attributes:
        skeleton: The skeleton.
        pose: The pose.
        gradient: Gradient of the energy on the independent degrees of freedom, (m,).
        matrix: Gauss-Newton matrix of the energy without the prior's, (m, m).
        prior: What was known of the pose before; None for the spread of the limits.
        shown: Share of each independent degree of freedom that is seen, (m,), from 0 to 1: the mean
            visibility of the primitives that it moves. What points tell of primitives that are
            hidden is no information on these, so the matrix counts by the share on both sides.
    """

    skeleton: Skeleton
    pose: Pose
    gradient: Array
    matrix: Array
    prior: Prior | None
    shown: Array

    @classmethod
    def of(
        cls,
        coordinates: TangentCoordinates,
        pose: Pose,
        solution: Solution,
        prior: Prior | None,
        shown: Array,
    ) -> PoseCurvature | None:
        """Returns the curvature at a solution; None if the solver does not return it.

        Args:
            coordinates: Coordinates of the solution.
            pose: Pose of the solution.
            solution: The solution.
            prior: The prior whose information the energy contains; None if it contains none.
            shown: Share of each independent degree of freedom that is seen, (m,).
        """
        if solution.gradient is None or solution.curvature is None:
            return None
        skeleton = coordinates.skeleton
        gradient, matrix = solution.gradient.copy(), solution.curvature.copy()
        first, hinges = 3 if skeleton.free else 0, skeleton.hinge_dofs.start
        to_tangent(solution.x, first, hinges, gradient, matrix)
        stiffness = None if prior is None else prior.stiffness
        if stiffness is not None:
            matrix -= _independent(skeleton, stiffness)
        return cls(skeleton, pose, gradient, matrix, prior, shown)

    @classmethod
    def at(
        cls,
        skeleton: Skeleton,
        pose: Pose,
        energy: FrameEnergy,
        prior: Prior | None,
        shown: Array,
    ) -> PoseCurvature | None:
        """Returns the curvature at any pose; None if a part of the energy has none.

        Solvers that do not need it, and other coordinates than steps on the tangent space, take one
        more evaluation of the energy.

        Args:
            skeleton: The skeleton.
            pose: The pose.
            energy: The energy.
            prior: The prior whose information the energy contains; None if it contains none.
            shown: Share of each independent degree of freedom that is seen, (m,).
        """
        _, force, matrix = energy.derivatives(pose, 2)
        if matrix is None:
            return None
        stiffness = None if prior is None else prior.stiffness
        if stiffness is not None:
            matrix = matrix - stiffness
        gradient = _independent_force(skeleton, force)
        return cls(skeleton, pose, gradient, _independent(skeleton, matrix).copy(), prior, shown)

    def information(self, points: float) -> Array:
        """Returns what the data alone tell of the independent degrees of freedom, (m, m)."""
        return points * self.matrix

    def pull(self, points: float) -> Array:
        """Returns minus N times the gradient of the data's energy, (m,)."""
        gradient, prior = self.gradient, self.prior
        stiffness = None if prior is None else prior.stiffness
        if prior is None or stiffness is None:
            return -points * gradient
        skeleton = self.skeleton
        step = skeleton.difference(prior.pose, self.pose)
        force = np.zeros(skeleton.dofs)
        first, hinges = 3 if skeleton.free else 0, skeleton.hinge_dofs.start
        add_at_end(step, stiffness @ step, force, first, hinges)
        # A prior of the filter has no information on coupled hinges.
        return -points * (gradient - force[skeleton.independent_dofs])

    def covariance(self, points: float) -> Array:
        """Returns the covariance (n, n) on the tangent space at the pose; NaN if it is unknown."""
        believed = points * self.matrix * self.shown * self.shown[:, None]
        return self._inverse(points, np.asarray(believed))

    def carried(self, points: float) -> Array:
        """Returns the covariance (n, n) that also counts what points tell of hidden parts."""
        return self._inverse(points, self.information(points))

    def _inverse(self, points: float, matrix: Array) -> Array:
        """Returns the covariance (n, n) with the information (m, m) of the data, overwritten."""
        skeleton = self.skeleton
        matrix += _independent(skeleton, self._before)
        pose = PoseArrays.of(self.pose)
        add_active_limits(skeleton.arrays, pose, points * self.gradient, matrix)
        inverse = inverted(matrix)
        if not len(skeleton.limits.couplings):
            return inverse
        return expanded(skeleton.arrays.limits, skeleton.hinge_dofs.start, inverse)

    @property
    def _before(self) -> Array:
        """Information before the frame, (n, n)."""
        if self.prior is not None and self.prior.information is not None:
            return self.prior.information
        return self.skeleton.spread_information


def _independent(skeleton: Skeleton, matrix: Array) -> Array:
    """Returns K^T A K (m, m) of a matrix A (n, n) with the couplings K, (n, m)."""
    couplings = skeleton.limits.couplings
    if not len(couplings):
        return matrix
    count = len(skeleton.independent_dofs)
    return contracted(skeleton.arrays.limits, skeleton.hinge_dofs.start, matrix, count)


def _independent_force(skeleton: Skeleton, force: Array) -> Array:
    """Returns K^T f (m,) of a force f (n,) with the couplings K, (n, m)."""
    hinges = skeleton.hinge_dofs.start
    return np.concatenate([force[:hinges], skeleton.limits.couplings.jacobian.T @ force[hinges:]])


def marker_covariances(jacobian: Array, covariance: Array) -> Array:
    """Returns the covariances J P J^T (M, 3, 3) [m^2] of markers.

    Args:
        jacobian: Derivative of the markers to the degrees of freedom, (M, 3, n).
        covariance: Covariance of the degrees of freedom, (n, n).
    """
    return np.asarray(jacobian @ covariance @ jacobian.transpose(0, 2, 1))
