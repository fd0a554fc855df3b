"""Whole Gaussians, and Gaussians with frozen covariances, as a kernel sees them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from regkit.gaussians.pairs import Moments
from regkit.gaussians.seen import Seen
from regkit.geometry.rotation import axial
from regkit.primitives import Gaussians, Placed
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Volume(Seen):
    """Whole Gaussians.

    Attributes:
        axes: R_world_primitive, (K, 3, 3).
        scales: Standard deviations, (K, 3) [m].
    """

    rigid: ClassVar[bool] = True
    axes: Array
    scales: Array

    @classmethod
    def of(cls, placed: Placed[Gaussians]) -> Volume:
        """Returns placed Gaussians as they are."""
        return cls(placed.centres, placed.axes, placed.primitives.scales)

    def precisions(self, variance: float) -> Array:
        """Returns P, which is diagonal in the Gaussian's own axes."""
        spread = (self.scales**2 + variance)[:, None, :]
        return np.asarray((self.axes / spread) @ self.axes.transpose(0, 2, 1))

    def log_volumes(self) -> Array:
        """Returns log |C| as the logarithm of the squared scales."""
        return np.asarray(2.0 * np.log(self.scales.prod(axis=1)))

    def areas(self) -> Array:
        """Returns the areas (K,) [m^2] of the largest sections of the 2-sigma ellipsoids."""
        scales = np.sort(self.scales, axis=1)
        return np.asarray(4.0 * np.pi * scales[:, 1] * scales[:, 2])

    def wrenches(self, moments: Moments, volume_power: float) -> Array:
        """Returns the forces -P q and their torques when applied at the data points y.

        The exact derivative to the rotation applies the forces at the product mean, m + C P q.
        Since q = C P q + sigma^2 P q, y lies on the same line of action.
        """
        pulls, levers = moments.pulls()
        wrenches = np.empty((len(pulls), 6))
        np.negative(pulls, out=wrenches[:, :3])
        wrenches[:, 3:] = axial(levers)
        return wrenches


@dataclass(frozen=True)
class Frozen(Seen):
    """Gaussians whose covariances stay those of the start pose, as in the paper (after eq. 11).

    Attributes:
        start: The Gaussians in the start pose.
    """

    rigid: ClassVar[bool] = True
    start: Seen

    @classmethod
    def of(cls, start: Seen, moved: Array) -> Frozen:
        """Returns Gaussians displaced by (K, 3) [m] since the start."""
        return cls(start.means + moved, start)

    def precisions(self, variance: float) -> Array:
        """Returns P in the start pose."""
        return self.start.precisions(variance)

    def log_volumes(self) -> Array:
        """Returns log |C| in the start pose."""
        return self.start.log_volumes()

    def areas(self) -> Array:
        """Returns the areas in the start pose."""
        return self.start.areas()

    def wrenches(self, moments: Moments, volume_power: float) -> Array:
        """Returns forces without torques."""
        pulls, _ = moments.pulls()
        return np.concatenate([-pulls, np.zeros_like(pulls)], axis=1)
