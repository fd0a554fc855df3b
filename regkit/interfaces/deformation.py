"""Deformations: smooth displacements of a registered body, beyond what its pose can do."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Self

from regkit.system.arrays import Array


class Deformation(ABC):
    """A map of the world onto itself that is applied to the body in its registered pose."""

    @abstractmethod
    def moved(self, points: Array) -> Array:
        """Returns where points (N, 3) [m] go, also points that were not registered themselves."""

    @abstractmethod
    def shifted(self, origin: Array) -> Self:
        """Returns the same deformation in a world whose origin is at ``-origin`` (3,) [m]."""
