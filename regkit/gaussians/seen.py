"""What a kernel compares with data: Gaussians as volumes, or the side of them that a camera sees.

Either way they are means and covariances, and moments of the data become wrenches on primitives.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from regkit.gaussians.compiled import inverses, visible_sides, visible_wrenches
from regkit.gaussians.pairs import Moments
from regkit.geometry.camera import Camera
from regkit.geometry.rotation import axial
from regkit.primitives import Gaussians, Placed, SurfaceGaussians
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
        """The area of each that a camera sees, (K,) [m^2], or that it shows at most."""

    @abstractmethod
    def wrenches(self, moments: Moments, volume_power: float) -> Array:
        """The derivative (K, 6) to the primitives' motions about their centres.

        It is that of sum w (1/2 q^T P q - 1/2 log |P| - volume_power / 2 log |C|), with the weights
        w of the moments.
        """


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
        """The primitives themselves."""
        return cls(placed.centres, placed.axes, placed.primitives.scales)

    def precisions(self, variance: float) -> Array:
        """P is diagonal in the Gaussian's own axes."""
        spread = (self.scales**2 + variance)[:, None, :]
        return np.asarray((self.axes / spread) @ self.axes.transpose(0, 2, 1))

    def log_volumes(self) -> Array:
        """Of the squared scales."""
        return np.asarray(2.0 * np.log(self.scales.prod(axis=1)))

    def areas(self) -> Array:
        """The largest sections of the 2-sigma ellipsoids."""
        scales = np.sort(self.scales, axis=1)
        return np.asarray(4.0 * np.pi * scales[:, 1] * scales[:, 2])

    def wrenches(self, moments: Moments, volume_power: float) -> Array:
        """The torque is that of the forces -P q applied at the data points y.

        The exact derivative to the rotation applies them at the product's mean, m + C P q. But y
        lies on the same line of action, since q = C P q + sigma^2 P q.
        """
        pulls, levers = moments.pulls()
        wrenches = np.empty((len(pulls), 6))
        np.negative(pulls, out=wrenches[:, :3])
        wrenches[:, 3:] = axial(levers)
        return wrenches


@dataclass(frozen=True)
class Frozen(Seen):
    """Gaussians whose covariances keep those of the start pose, as the paper has it (after eq. 11).

    Attributes:
        start: How they were seen there.
    """

    rigid: ClassVar[bool] = True
    start: Seen

    @classmethod
    def of(cls, start: Seen, moved: Array) -> Frozen:
        """Gaussians that have moved by (K, 3) [m] since the start."""
        return cls(start.means + moved, start)

    def precisions(self, variance: float) -> Array:
        """Those of the start."""
        return self.start.precisions(variance)

    def log_volumes(self) -> Array:
        """Those of the start."""
        return self.start.log_volumes()

    def areas(self) -> Array:
        """Those of the start."""
        return self.start.areas()

    def wrenches(self, moments: Moments, volume_power: float) -> Array:
        """Forces alone."""
        pulls, _ = moments.pulls()
        return np.concatenate([-pulls, np.zeros_like(pulls)], axis=1)


@dataclass(frozen=True)
class Visible(Seen):
    """The front of 2-sigma ellipsoids, for a camera at the origin.

    Along the unit ray e to its centre m an ellipsoid reaches h = 2 / sqrt(e^T C^-1 e) before the
    centre. Its visible side has the mean m - 2/3 h e, the covariance C - (1/4 - 1/18) h^2 e e^T,
    and the area pi sqrt(|4 C| e^T (4 C)^-1 e).

    Attributes:
        covariances: Of the visible side, (K, 3, 3) [m^2].
        whole: C, of the whole ellipsoid, (K, 3, 3) [m^2].
        pulled: C^-1 e, (K, 3).
        rays: e, (K, 3).
        reaches: h, (K, 1) [m].
        distances: |m|, (K, 1) [m].
    """

    rigid: ClassVar[bool] = False
    covariances: Array
    whole: Array
    pulled: Array
    rays: Array
    reaches: Array
    distances: Array

    @classmethod
    def of(cls, placed: Placed[Gaussians]) -> Visible:
        """The visible side of the primitives."""
        return cls(
            *visible_sides(
                placed.centres, placed.axes, placed.primitives.scales, _DEPTH, _FLATTENING
            )
        )

    def precisions(self, variance: float) -> Array:
        """The visible side's axes are not the Gaussian's own, so P is inverted."""
        return inverses(self.covariances, variance)[0]

    def log_volumes(self) -> Array:
        """Of the visible sides."""
        return inverses(self.covariances, 0.0)[1]

    def areas(self) -> Array:
        """Pi sqrt(|4 C| e^T (4 C)^-1 e), with e^T C^-1 e = 4 / h^2."""
        roots = np.sqrt(np.linalg.det(self.whole))
        return np.asarray(8.0 * np.pi * roots / self.reaches[:, 0])

    def wrenches(self, moments: Moments, volume_power: float) -> Array:
        """By the chain rule through the covariance, h and e.

        With a and G the derivatives to mean and covariance, k = 7/36 and b = C^-1 e,

            dE = a.dm + <G, dC> + (-2/3 a.e - 2 k h e^T G e) dh + (-2/3 h a - 2 k h^2 G e).de,
            dh = -h^3/4 (b.de + w.(b x e)),    de = (I - e e^T) dm / |m|,    dC = [w]x C - C [w]x.
        """
        shrinking = np.zeros_like(self.whole)
        if volume_power:
            mass = 0.5 * volume_power * moments.mass[:, None, None]
            shrinking = mass * inverses(self.covariances, 0.0)[0]
        return visible_wrenches(
            moments.mass,
            moments.about,
            moments.relative,
            moments.precisions,
            shrinking,
            self.whole,
            self.pulled,
            self.rays,
            self.reaches,
            self.distances,
            _DEPTH,
            _FLATTENING,
        )


def seen(placed: Placed[Gaussians], camera: Camera | None) -> Seen:
    """The visible side, if the shape model asks for it and there is a camera; else the volume."""
    if camera is not None and isinstance(placed.primitives, SurfaceGaussians):
        return Visible.of(placed)
    return Volume.of(placed)


_DEPTH = 2.0 / 3.0
"""How far before the centre the visible side's mean is, as a part of h."""

_FLATTENING = 1.0 / 4.0 - 1.0 / 18.0
"""What its variance along the ray lacks of the whole ellipsoid's, as a part of h^2."""
