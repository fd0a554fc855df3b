"""Gaussians as a kernel sees them: means and covariances.

The moments of the data under them become wrenches on the primitives.
"""

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
        means: (K, 3) [m].
    """

    means: Array

    rigid: ClassVar[bool]
    """Whether the covariances only turn, so that their determinants do not depend on the pose."""

    @abstractmethod
    def precisions(self, variance: float) -> Array:
        """P = (C + variance I)^-1, (K, 3, 3)."""

    @abstractmethod
    def log_volumes(self) -> Array:
        """Log |C|, (K,)."""

    @abstractmethod
    def areas(self) -> Array:
        """Returns the area of each that a camera sees, (K,) [m^2], or that it shows at most."""

    @abstractmethod
    def wrenches(self, moments: Moments, volume_power: float) -> Array:
        """Returns the derivative (K, 6) to the primitives' motions about their centres.

        It is that of sum w (1/2 q^T P q - 1/2 log |P| - volume_power / 2 log |C|), with the weights
        w of the moments.
        """
