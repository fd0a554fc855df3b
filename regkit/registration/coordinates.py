"""Coordinates of poses: the vectors that a solver moves."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import conjugate, from_matrix, normalized, product, to_matrix
from regkit.interfaces import Constraints
from regkit.registration.constraints import quaternion_constraints, tangent_constraints
from regkit.skeleton import Couplings, Pose, Skeleton
from regkit.skeleton.compiled_steps import step_jacobian
from regkit.system.arrays import Array

CoordinatesName = Literal["tangent", "quaternion"]


@dataclass(frozen=True)
class Coordinates(ABC):
    """A chart around a start pose: vectors x (m,) <-> poses.

    Attributes:
        skeleton: Whose poses.
        start: The pose of ``origin()``.
    """

    unique: ClassVar[bool]
    """Whether each pose has one vector only."""

    skeleton: Skeleton
    start: Pose

    @property
    def _couplings(self) -> Couplings:
        return self.skeleton.limits.couplings

    @abstractmethod
    def origin(self) -> Array:
        """The coordinates (m,) of the start pose."""

    @abstractmethod
    def pose(self, x: Array) -> Pose:
        """The pose at coordinates x (m,)."""

    @abstractmethod
    def vector(self, pose: Pose) -> Array:
        """The coordinates (m,) of a pose."""

    @abstractmethod
    def jacobian(self, x: Array) -> Array:
        """D (n, m) at x: a change dx moves the degrees of freedom at ``pose(x)`` by D dx.

        So a generalised force f has the gradient D^T f, and a normal matrix H the form D^T H D.
        """

    @abstractmethod
    def bounds(self) -> tuple[Array, Array]:
        """Lower and upper bounds (m,) that keep the hinges within their limits."""

    @abstractmethod
    def constraints(self) -> Constraints | None:
        """What keeps the ball joints within their limits, or None if none has any."""


@dataclass(frozen=True)
class TangentCoordinates(Coordinates):
    """Steps on the tangent space at the start: 6 for a free root, 3 for a ball, 1 for a hinge.

    A hinge that follows another has none.
    """

    unique = True

    def origin(self) -> Array:
        """Zero."""
        return np.zeros(self.skeleton.dofs - len(self._couplings))

    def pose(self, x: Array) -> Pose:
        """``retract(start, x)``, followers made to follow."""
        if not len(self._couplings):
            return self.skeleton.retract(self.start, x)
        pose = self.skeleton.retract(self.start, self._step(x))
        return Pose(pose.root, pose.balls, self._couplings.coupled(pose.hinges))

    def vector(self, pose: Pose) -> Array:
        """The step from the start to a pose, its rotations of at most half a turn."""
        return self._independent(self.skeleton.difference(self.start, pose))

    def jacobian(self, x: Array) -> Array:
        """By the right Jacobian of each rotation vector: exp(w + dw) = exp(w) exp(J dw)."""
        first = 3 if self.skeleton.free else 0
        hinges = self.skeleton.hinge_dofs
        jacobian = step_jacobian(self._step(x), first, hinges.start)
        if not len(self._couplings):
            return jacobian
        return np.hstack([
            jacobian[:, : hinges.start], jacobian[:, hinges] @ self._couplings.jacobian
        ])  # fmt: skip

    def bounds(self) -> tuple[Array, Array]:
        """The hinges' limits, and half a turn for each part of a rotation vector."""
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
        """The swings and twists of the ball joints that have limits."""
        return tangent_constraints(self.skeleton, self.start.balls, len(self.origin()))

    def _step(self, x: Array) -> Array:
        """The step (n,) of all degrees of freedom at x (m,)."""
        if not len(self._couplings):
            return x
        hinges = self.skeleton.hinge_dofs.start
        return np.concatenate([x[:hinges], self._couplings.jacobian @ x[hinges:]])

    def _independent(self, step: Array) -> Array:
        """The part (m,) of a step (n,) that followers have no part in."""
        return np.delete(step, self.skeleton.hinge_dofs.start + self._couplings.followers)


@dataclass(frozen=True)
class QuaternionCoordinates(Coordinates):
    """The paper's pose parameters [t, r(1), ..., r(L)]: un-normalised quaternions, ``p = r / |r|``.

    L counts the root's rotation and the ball joints: 4 L + 3 parameters, and one more for each
    hinge that follows no other. Their lengths mean nothing; ``vector`` gives unit ones.
    """

    unique = False

    def origin(self) -> Array:
        """The start's translation, unit quaternions and hinge angles."""
        return self.vector(self.start)

    def pose(self, x: Array) -> Pose:
        """The pose whose rotations are the normalised quaternions."""
        quaternions, hinges = self._split(x)
        unit = normalized(quaternions)
        if not self.skeleton.free:
            return Pose(self.start.root, unit, hinges)
        return Pose(rigid(to_matrix(unit[0]), x[:3]), unit[1:], hinges)

    def jacobian(self, x: Array) -> Array:
        """By the angular rate ``2 vec(p* dr) / |r|``; the part of dr along r turns nothing."""
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
        """The hinges' limits; a quaternion has none."""
        lower, upper = np.full_like(self.origin(), -np.inf), np.full_like(self.origin(), np.inf)
        own = self._couplings.independent
        limits, start = self.skeleton.limits.hinge[own], self.start.hinges[own]
        first = len(lower) - len(own)
        lower[first:] = np.minimum(limits[:, 0], start)
        upper[first:] = np.maximum(limits[:, 1], start)
        return lower, upper

    def constraints(self) -> Constraints | None:
        """The swings and twists that have limits, and the norms of all quaternions."""
        return quaternion_constraints(self.skeleton, len(self.origin()))

    def vector(self, pose: Pose) -> Array:
        """A pose's translation, unit quaternions and hinge angles."""
        root = [pose.root[:3, 3], from_matrix(pose.root[:3, :3])] if self.skeleton.free else []
        own = pose.hinges[self._couplings.independent]
        return np.concatenate([*root, pose.balls.ravel(), own])

    def _split(self, x: Array) -> tuple[Array, Array]:
        """The un-normalised quaternions (L, 4) and all hinge angles (n_hinge,)."""
        own = self._couplings.independent
        first = len(x) - len(own)
        hinges = np.zeros(self._couplings.hinges)
        hinges[own] = x[first:]
        start = 3 if self.skeleton.free else 0
        return x[start:first].reshape(-1, 4), self._couplings.coupled(hinges)


COORDINATES: dict[CoordinatesName, type[Coordinates]] = {
    "tangent": TangentCoordinates,
    "quaternion": QuaternionCoordinates,
}
