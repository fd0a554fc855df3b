"""Coordinates of poses: the vectors that a solver moves."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

from regkit.interfaces import Constraints
from regkit.skeleton import Couplings, Pose, Skeleton
from regkit.system.arrays import Array


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
        """Returns the coordinates (m,) of the start pose."""

    @abstractmethod
    def pose(self, x: Array) -> Pose:
        """Returns the pose at coordinates x (m,)."""

    @abstractmethod
    def vector(self, pose: Pose) -> Array:
        """Returns the coordinates (m,) of a pose."""

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
