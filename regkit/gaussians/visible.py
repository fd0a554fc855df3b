"""The visible side of Gaussians."""

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
    """The visible side of 2-sigma ellipsoids, for a camera at the origin.

    Along the unit ray e to its centre m, the surface of an ellipsoid lies h = 2 / sqrt(e^T C^-1 e)
    before the centre. Its visible side has the mean m - 2/3 h e, the covariance
    C - (1/4 - 1/18) h^2 e e^T and the projected area pi sqrt(|4 C| e^T (4 C)^-1 e).

    Attributes:
        covariances: Covariances of the visible sides, (K, 3, 3) [m^2].
        whole: C, covariances of the whole ellipsoids, (K, 3, 3) [m^2].
        pulled: C^-1 e, (K, 3) [1/m^2].
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
        """Returns the visible sides of placed Gaussians."""
        return cls(
            *visible_sides(placed.centres, placed.axes, placed.primitives.scales, DEPTH, FLATTENING)
        )

    def precisions(self, variance: float) -> Array:
        """Returns P by inversion: the visible side's axes are not the Gaussian's own."""
        return inverses(self.covariances, variance)[0]

    def log_volumes(self) -> Array:
        """Returns log |C| of the visible sides, (K,)."""
        return inverses(self.covariances, 0.0)[1]

    def areas(self) -> Array:
        """Returns pi sqrt(|4 C| e^T (4 C)^-1 e), where e^T C^-1 e = 4 / h^2, (K,) [m^2]."""
        roots = np.sqrt(np.linalg.det(self.whole))
        return np.asarray(8.0 * np.pi * roots / self.reaches[:, 0])

    def wrenches(self, moments: Moments, volume_power: float) -> Array:
        """Returns the derivative (K, 6) by the chain rule through the covariance, h and e.

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
            DEPTH,
            FLATTENING,
        )


def seen(placed: Placed[Gaussians], camera: Camera | None) -> Seen:
    """Returns the visible sides of surface Gaussians before a camera, else whole Gaussians."""
    if camera is not None and isinstance(placed.primitives, SurfaceGaussians):
        return Visible.of(placed)
    return Volume.of(placed)


DEPTH = 2.0 / 3.0
"""Offset of the visible side's mean towards the camera, as a fraction of h."""

FLATTENING = 1.0 / 4.0 - 1.0 / 18.0
"""Reduction of the variance along the ray by occlusion, as a fraction of h^2."""
