"""Coordinates of poses: the variables of a solver."""

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
        skeleton: The skeleton of the poses.
        start: The pose at ``origin()``.
    """

    unique: ClassVar[bool]
    """Whether each pose has exactly one coordinate vector."""

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
        """Returns D (n, m) at x: a change dx moves the degrees of freedom at ``pose(x)`` by D dx.

        A generalised force f thus has the gradient D^T f, and a normal matrix H becomes D^T H D.
        """

    @abstractmethod
    def bounds(self) -> tuple[Array, Array]:
        """Returns lower and upper bounds (m,) that keep the hinges within their limits."""

    @abstractmethod
    def constraints(self) -> Constraints | None:
        """Returns constraints that keep the ball joints within their limits; None without any."""
