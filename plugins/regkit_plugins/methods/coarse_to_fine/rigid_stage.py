"""One resolution of a rigid body: nothing but a transform changes from step to step."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from regkit.interfaces import Problem, RigidComparison, RigidSimilarity
from regkit.skeleton import Pose
from regkit.skeleton.compiled_steps import retracted_root
from regkit.system.arrays import Array
from regkit_plugins.methods.coarse_to_fine.compiled_rigid import pulled_back
from regkit_plugins.methods.coarse_to_fine.stages import Round, Stage

LOWER = np.array([-np.inf, -np.inf, -np.inf, -np.pi, -np.pi, -np.pi])
"""Lower bounds of a step: no component of a rotation vector is beyond half a turn."""


@dataclass(frozen=True)
class RigidStage(Stage):
    """A stage of a body of one free segment.

    Attributes:
        comparison: The kernel, bound to the data and to the body's Gaussians.
        centres: The Gaussians' centres in the body's frame, (K, 3) [m].
    """

    comparison: RigidComparison
    centres: Array

    def round(self, pose: Pose) -> RigidRound:
        """Returns the problem with the pairs of a pose."""
        return RigidRound(pose, RigidProblem(self.comparison.paired(pose.root), pose.root))

    def distance(self, first: Pose, second: Pose) -> float:
        """Returns the root mean square distance [m] of the Gaussians between two poses."""
        change = second.root - first.root
        turn, shift = change[:3, :3], change[:3, 3]
        mean, moments = self._moments
        square = (turn @ moments * turn).sum() + 2.0 * shift @ turn @ mean + shift @ shift
        return float(np.sqrt(max(square, 0.0)))

    @cached_property
    def _moments(self) -> tuple[Array, Array]:
        """The means of the centres (3,) [m] and of their outer products (3, 3) [m^2]."""
        return self.centres.mean(axis=0), self.centres.T @ self.centres / len(self.centres)


@dataclass(frozen=True)
class RigidRound(Round):
    """A round of a rigid body.

    Attributes:
        start: The start pose.
        problem: The problem.
    """

    start: Pose
    problem: RigidProblem

    def pose(self, x: Array) -> Pose:
        """Returns the pose at a step x (6,)."""
        return Pose(self.problem.transform(x), self.start.balls, self.start.hinges)

    def inlier_probability(self, pose: Pose) -> Array:
        """Returns the inlier probability of each point, (N,)."""
        return self.problem.similarity.inlier_probability(pose.root)


class RigidProblem(Problem):
    """The energy of a rigid body over steps on the tangent space of its root.

    It is the ``RegistrationProblem`` of a single free segment in ``TangentCoordinates``, without
    the sums over primitives and segments.

    Args:
        similarity: The similarity with fixed pairs.
        root: T_world_body at the start, (4, 4).
    """

    def __init__(self, similarity: RigidSimilarity, root: Array) -> None:
        self.similarity = similarity
        self._root = root
        self.start = np.zeros(6)
        self.lower, self.upper = LOWER, -LOWER

    def transform(self, x: Array) -> Array:
        """Returns T_world_body (4, 4) after a step x (6,); see ``Skeleton.retract``."""
        return retracted_root(self._root, x)

    def projected(self, x: Array) -> Array:
        """Returns the step x (6,) with each component of its rotation within half a turn."""
        return np.minimum(np.maximum(x, self.lower), self.upper)

    def value_and_gradient(self, x: Array) -> tuple[float, Array]:
        """Returns the energy at a step x (6,) and its gradient (6,)."""
        value, gradient, _ = self.normal_equations(x)
        return value, gradient

    def normal_equations(self, x: Array) -> tuple[float, Array, Array]:
        """Returns the energy, its gradient (6,) and Gauss-Newton matrix (6, 6) at x (6,)."""
        transform = self.transform(x)
        response = self.similarity(transform)
        assert response.stiffness is not None
        gradient, matrix = pulled_back(x, transform, response.wrenches[0], response.stiffness[0])
        return response.energy, gradient, matrix
