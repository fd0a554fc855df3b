"""Steps on the tangent space as coordinates of poses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.interfaces import Constraints
from regkit.registration.constraints import tangent_constraints
from regkit.registration.coordinates import Coordinates
from regkit.skeleton import Pose
from regkit.skeleton.compiled_steps import step_jacobian
from regkit.system.arrays import Array


@dataclass(frozen=True)
class TangentCoordinates(Coordinates):
    """Steps on the tangent space at the start: 6 for a free root, 3 for a ball, 1 for a hinge.

    A coupled hinge has none.
    """

    unique = True

    def origin(self) -> Array:
        """Returns zeros (m,)."""
        return np.zeros(self.skeleton.dofs - len(self._couplings))

    def pose(self, x: Array) -> Pose:
        """Returns ``retract(start, x)`` with coupled hinges set from their leaders."""
        if not len(self._couplings):
            return self.skeleton.retract(self.start, x)
        pose = self.skeleton.retract(self.start, self._step(x))
        return Pose(pose.root, pose.balls, self._couplings.coupled(pose.hinges))

    def vector(self, pose: Pose) -> Array:
        """Returns the step (m,) from the start to a pose, with rotations of at most half a turn."""
        return self._independent(self.skeleton.difference(self.start, pose))

    def jacobian(self, x: Array) -> Array:
        """Returns D from the right Jacobians of the rotation vectors.

        They satisfy exp(w + dw) = exp(w) exp(J dw) to first order.
        """
        first = 3 if self.skeleton.free else 0
        hinges = self.skeleton.hinge_dofs
        jacobian = step_jacobian(self._step(x), first, hinges.start)
        if not len(self._couplings):
            return jacobian
        return np.hstack([
            jacobian[:, : hinges.start], jacobian[:, hinges] @ self._couplings.jacobian
        ])  # fmt: skip

    def bounds(self) -> tuple[Array, Array]:
        """Returns the hinges' limits, and half a turn for each component of a rotation vector."""
        lower, upper = np.full((2, self.skeleton.dofs), np.pi)
        lower = -lower
        if self.skeleton.free:
            lower[:3], upper[:3] = -np.inf, np.inf
        hinges = self.skeleton.hinge_dofs
        lower[hinges] = self.skeleton.limits.hinge[:, 0] - self.start.hinges
        upper[hinges] = self.skeleton.limits.hinge[:, 1] - self.start.hinges
        lower, upper = self._independent(lower), self._independent(upper)
        return np.minimum(lower, 0.0), np.maximum(upper, 0.0)

    def constraints(self) -> Constraints | None:
        """Returns the limits of swings and twists as constraints; None without any."""
        return tangent_constraints(self.skeleton, self.start.balls, len(self.origin()))

    def _step(self, x: Array) -> Array:
        """Returns the step (n,) of all degrees of freedom at x (m,)."""
        if not len(self._couplings):
            return x
        hinges = self.skeleton.hinge_dofs.start
        return np.concatenate([x[:hinges], self._couplings.jacobian @ x[hinges:]])

    def _independent(self, step: Array) -> Array:
        """Returns the entries (m,) of a step (n,) without those of coupled hinges."""
        if not len(self._couplings):
            return step
        return np.delete(step, self.skeleton.hinge_dofs.start + self._couplings.followers)
