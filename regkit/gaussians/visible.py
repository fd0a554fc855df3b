"""The side of Gaussians that a camera sees."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from regkit.gaussians.compiled import inverses, visible_sides, visible_wrenches
from regkit.gaussians.pairs import Moments
from regkit.gaussians.seen import Seen
from regkit.gaussians.volume import Volume
from regkit.geometry.camera import Camera
from regkit.primitives import Gaussians, Placed, SurfaceGaussians
from regkit.system.arrays import Array


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
        """Returns the visible side of the primitives."""
        return cls(
            *visible_sides(
                placed.centres, placed.axes, placed.primitives.scales, _DEPTH, _FLATTENING
            )
        )

    def precisions(self, variance: float) -> Array:
        """Returns the visible side's axes are not the Gaussian's own, so P is inverted."""
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
