"""The paper's un-normalised quaternions as coordinates of poses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import conjugate, from_matrix, normalized, product, to_matrix
from regkit.interfaces import Constraints
from regkit.registration.constraints import quaternion_constraints
from regkit.registration.coordinates import Coordinates
from regkit.skeleton import Pose
from regkit.system.arrays import Array


@dataclass(frozen=True)
class QuaternionCoordinates(Coordinates):
    """The paper's pose parameters [t, r(1), ..., r(L)]: un-normalised quaternions, ``p = r / |r|``.

    L counts the root's rotation and the ball joints: 4 L + 3 parameters, plus one for each
    independent hinge. The lengths of the quaternions are arbitrary; ``vector`` returns unit ones.
    """

    unique = False

    def origin(self) -> Array:
        """Returns the start's translation, unit quaternions and hinge angles, (m,)."""
        return self.vector(self.start)

    def pose(self, x: Array) -> Pose:
        """Returns the pose with the normalised quaternions as rotations."""
        quaternions, hinges = self._split(x)
        unit = normalized(quaternions)
        if not self.skeleton.free:
            return Pose(self.start.root, unit, hinges)
        return Pose(rigid(to_matrix(unit[0]), x[:3]), unit[1:], hinges)

    def jacobian(self, x: Array) -> Array:
        """Returns D from the rates ``2 vec(p* dr) / |r|``; dr along r has no effect."""
        quaternions, _ = self._split(x)
        inverse = conjugate(normalized(quaternions)) * (
            2.0 / np.linalg.norm(quaternions, axis=1, keepdims=True)
        )
        rates = product(inverse[:, None, :], np.eye(4))[..., :3]  # (L, 4, 3), a row for each of r
        start = 3 if self.skeleton.free else 0
        jacobian = np.zeros((self.skeleton.dofs, len(x)))
        jacobian[:start, :start] = np.eye(start)
        rows = start + np.arange(3 * len(rates)).reshape(-1, 3)
        columns = start + np.arange(4 * len(rates)).reshape(-1, 4)
        jacobian[rows[:, :, None], columns[:, None, :]] = np.swapaxes(rates, 1, 2)
        last = len(x) - len(self._couplings.independent)
        jacobian[self.skeleton.hinge_dofs, last:] = self._couplings.jacobian
        return jacobian

    def bounds(self) -> tuple[Array, Array]:
        """Returns the hinges' limits; quaternions are unbounded."""
        lower, upper = np.full_like(self.origin(), -np.inf), np.full_like(self.origin(), np.inf)
        own = self._couplings.independent
        limits, start = self.skeleton.limits.hinge[own], self.start.hinges[own]
        first = len(lower) - len(own)
        lower[first:] = np.minimum(limits[:, 0], start)
        upper[first:] = np.maximum(limits[:, 1], start)
        return lower, upper

    def constraints(self) -> Constraints | None:
        """Returns the limits on swings and twists, and the norms of all quaternions."""
        return quaternion_constraints(self.skeleton, len(self.origin()))

    def vector(self, pose: Pose) -> Array:
        """Returns a pose's translation, unit quaternions and hinge angles."""
        root = [pose.root[:3, 3], from_matrix(pose.root[:3, :3])] if self.skeleton.free else []
        own = pose.hinges[self._couplings.independent]
        return np.concatenate([*root, pose.balls.ravel(), own])

    def _split(self, x: Array) -> tuple[Array, Array]:
        """Returns the un-normalised quaternions (L, 4) and all hinge angles (n_hinge,) [rad]."""
        own = self._couplings.independent
        first = len(x) - len(own)
        hinges = np.zeros(self._couplings.hinges)
        hinges[own] = x[first:]
        start = 3 if self.skeleton.free else 0
        return x[start:first].reshape(-1, 4), self._couplings.coupled(hinges)
