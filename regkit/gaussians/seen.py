"""Gaussians as a kernel sees them: means and covariances, and wrenches from their moments."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

from regkit.gaussians.pairs import Moments
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Seen(ABC):
    """K Gaussians in the world, as a kernel sees them.

    Attributes:
        means: Means in the world, (K, 3) [m].
    """

    means: Array

    rigid: ClassVar[bool]
    """Whether the covariances only rotate, so that their determinants do not depend on the pose."""

    @abstractmethod
    def precisions(self, variance: float) -> Array:
        """Returns P = (C + variance I)^-1 (K, 3, 3) [1/m^2] for a data variance [m^2]."""

    @abstractmethod
    def log_volumes(self) -> Array:
        """Returns log |C|, (K,)."""

    @abstractmethod
    def areas(self) -> Array:
        """Returns the visible area of each, or without a camera its largest section, (K,) [m^2]."""

    @abstractmethod
    def wrenches(self, moments: Moments, volume_power: float) -> Array:
        """Returns the derivative (K, 6) to the primitives' motions about their centres.

        The energy is sum w (1/2 q^T P q - 1/2 log |P| - volume_power / 2 log |C|) with the fixed
        weights w of the moments.
        """
