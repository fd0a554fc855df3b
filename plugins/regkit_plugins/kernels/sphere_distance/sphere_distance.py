"""The signed distance of data to the surface of capsules and spheres."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from regkit.interfaces import Kernel
from regkit.observation import Observation
from regkit.primitives import Placed, Primitives, TaperedCapsules
from regkit.registration import Residuals, ResidualSimilarity, Robust
from regkit.registration.robust import Squares
from regkit.system.arrays import Array, Indices
from regkit_plugins.kernels.sphere_distance.compiled import (
    nearest_capsules,
    residuals_and_rows,
)


class SphereDistance(Kernel):
    """Distance of each point to the nearest surface of the union of all primitives.

    The energy is the mean over the points of a robust loss of the distance in units of its
    deviation s, which is minus the logarithm of a density, as is that of ``likelihood``: the
    weights of terms mean the same under both. Where s is estimated, log s is a part of it, so that
    poses can be compared for which it differs.

    A primitive of the weight w takes part as one of the share w in a mixture: a point belongs to
    where d |d| / (2 s^2) - log w is least, and - log w is a part of its energy, with the greatest w
    as one. Where all weights are the same, that is the nearest surface.
    """

    kind: Literal["sphere_distance"] = "sphere_distance"
    accepts: ClassVar[type[Primitives]] = TaperedCapsules

    robust: Robust = Robust()
    """What a distance costs."""
    side: Literal["front", "whole"] = "front"
    """Whether a point that is nearer to the back of a primitive, which the camera cannot have seen,
    is held against the outline of its front; where there is no camera the whole surface counts."""

    def bind(
        self, observation: Observation, start: Placed[TaperedCapsules], *, smoothing: float = 0.0
    ) -> BoundSphereDistance:
        """Bind the kernel to a frame's data; the loss keeps the scale of the start."""
        return BoundSphereDistance(self, observation, start, smoothing)


class BoundSphereDistance(ResidualSimilarity):
    """The distances of one frame's points.

    For a point at the height y along a capsule's axis and at the distance x from it, the nearest
    sphere has its centre c at the height y - x tan(a), kept between the ends, with a the half angle
    of the cone. With q = y - c and the radius r there, the signed distance is d = |q| - r, and its
    derivative to the point is q / |q|: that to c vanishes, for the sphere is the nearest.

    Where the part h = q.e of q along the point's own ray e is positive, the surface faces away from
    the camera. The residual then is the distance to the outline of the sphere's front,

        sqrt(h^2 + (|q - h e| - r)^2),

    which continues |d|. It is no least distance over the spheres of a capsule, so that its
    derivative has a part through the place of c, and one through e, which turns in the primitive's
    own frame as this rotates.
    """

    def __init__(
        self,
        kernel: SphereDistance,
        observation: Observation,
        start: Placed[TaperedCapsules],
        smoothing: float,
    ) -> None:
        # The scale of the loss follows from the distances at the start.
        super().__init__(observation, Squares(1.0))
        self._front = kernel.side == "front" and observation.camera is not None
        weights = start.primitives.weights
        self._surprise = np.log(weights.max() / weights)
        self._robust = kernel.robust
        self._deviation = float(np.sqrt(self.weights @ observation.variances))
        self._scale = self._deviation
        _, distances, _ = self._nearest(start)
        self.loss = kernel.robust.bound(distances, least=self._deviation, smoothing=smoothing)
        self._scale = self.loss.scale
        self._constant = float(np.log(self._scale / self._deviation))

    def inlier_probability(self, placed: Placed[TaperedCapsules]) -> Array | None:
        """The loss's weight of each point's distance, (N,); None by squares, which cannot tell.

        An estimated scale is that of the distances in this very pose, for those at the start
        include the body's motion.
        """
        _, distances, _ = self._nearest(placed)
        loss = self._robust.bound(distances, least=self._deviation)
        return loss.inlier_probability(distances) if np.isfinite(loss.tuning) else None

    def residuals(self, placed: Placed[TaperedCapsules]) -> Residuals:
        """Returns the distance of each point to the nearest capsule."""
        owners, distances, rows = self._nearest(placed)
        constant = self._constant + float(self.weights @ self._surprise[owners])
        return Residuals(owners, distances, rows, self.weights, constant)

    def _nearest(self, placed: Placed[TaperedCapsules]) -> tuple[Indices, Array, Array]:
        """Each point's primitive (N,), residual (N,) [m], and its derivative (N, 6) to motions."""
        primitives = placed.primitives
        capsules = np.empty((len(placed), 9))
        capsules[:, :3], capsules[:, 3:6] = placed.centres, placed.axes[:, :, 1]
        capsules[:, 6], capsules[:, 7] = primitives.halves, primitives.radii.mean(axis=1)
        capsules[:, 8] = primitives.sines
        handicaps = 2.0 * self._scale**2 * self._surprise
        owners, distances, places = nearest_capsules(self.points, capsules, handicaps)
        residuals, rows = residuals_and_rows(
            self.points, capsules, owners, distances, places, self._front
        )
        return owners, residuals, rows
