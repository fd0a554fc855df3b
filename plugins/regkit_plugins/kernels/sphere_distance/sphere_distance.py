"""The sphere-distance kernel: signed distances of data to capsules and spheres."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from regkit.interfaces import CompiledEnergy, Kernel
from regkit.observation import Observation
from regkit.primitives import Placed, Primitives, TaperedCapsules
from regkit.registration import Residuals, ResidualSimilarity, Robust
from regkit.registration.compiled_robust import loss_number
from regkit.registration.robust import Squares
from regkit.system.arrays import Array, Indices
from regkit_plugins.kernels.sphere_distance.compiled import (
    nearest_capsules,
    residuals_and_rows,
)
from regkit_plugins.kernels.sphere_distance.compiled_kernel import bind, explain, respond


class SphereDistance(Kernel):
    """Distance of each point to the nearest surface of the union of all primitives.

    The energy is the mean over the points of a robust loss of the distance in units of its standard
    deviation s. Like that of ``likelihood`` it is a negative log-density, so that the weights of
    terms are comparable. If s is estimated, the energy includes log s, so that poses with different
    s are comparable.

    A primitive's weight w acts as a mixture weight: a point belongs to the primitive with the least
    d |d| / (2 s^2) - log w, and the energy includes - log w, relative to the greatest w. With equal
    weights this is the nearest surface.
    """

    kind: Literal["sphere_distance"] = "sphere_distance"
    accepts: ClassVar[type[Primitives]] = TaperedCapsules

    robust: Robust = Robust()
    """Robust loss of a distance."""
    side: Literal["front", "whole"] = "front"
    """Whether a point near the back of a primitive, which the camera cannot have seen, is compared
    with the outline of its front; without a camera the whole surface is used."""

    def bind(
        self, observation: Observation, start: Placed[TaperedCapsules], *, smoothing: float = 0.0
    ) -> BoundSphereDistance:
        """Binds the kernel to the data of a frame; the loss keeps the scale of the start."""
        return BoundSphereDistance(self, observation, start, smoothing)

    def compiled(self, primitives: Primitives) -> CompiledEnergy | None:
        """Returns the kernel as compiled functions, for tapered capsules."""
        if type(primitives) is not TaperedCapsules:
            return None
        scale = np.nan if self.robust.scale is None else self.robust.scale
        numbers = (self.side == "front", loss_number(self.robust.kind), scale)
        shape = (primitives.halves, primitives.radii.mean(axis=1), primitives.sines)
        state = (len(primitives) + 1, 1)
        return CompiledEnergy(respond, numbers, np.column_stack(shape), bind, state, explain)


class BoundSphereDistance(ResidualSimilarity):
    """``SphereDistance`` bound to a frame.

    For a point at the height y along a capsule's axis and at the distance x from it, the nearest
    sphere has its centre c at the height y - x tan(a), clipped to the ends, with the half angle a
    of the cone. With q = y - c and the radius r there, the signed distance is d = |q| - r. Its
    derivative to the point is q / |q|; the derivative to c vanishes, since the sphere is nearest.

    Where the component h = q.e of q along the point's viewing ray e is positive, the surface faces
    away from the camera. The residual is then the distance to the outline of the sphere's front,

        sqrt(h^2 + (|q - h e| - r)^2),

    which continues |d|. It is not minimal over the spheres of a capsule, so that its derivative has
    a part through c, and a part through e, which rotates in the primitive's own frame.

    Args:
        kernel: The kernel.
        observation: The data.
        start: The capsules in the start pose.
        smoothing: Standard deviation that widens the loss [m].
    """

    def __init__(
        self,
        kernel: SphereDistance,
        observation: Observation,
        start: Placed[TaperedCapsules],
        smoothing: float,
    ) -> None:
        # The scale of the loss depends on the distances at the start.
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
        """Returns the loss's weight of each distance, (N,); None for squares, which accept all.

        An estimated scale is that of the distances in this pose, because those at the start contain
        the body's motion.
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
        """Returns each point's primitive (N,), residual (N,) [m] and derivative (N, 6)."""
        primitives = placed.primitives
        capsules = np.empty((len(placed), 9))
        capsules[:, :3], capsules[:, 3:6] = placed.centres, placed.axes[:, :, 1]
        capsules[:, 6], capsules[:, 7] = primitives.halves, primitives.radii.mean(axis=1)
        capsules[:, 8] = primitives.sines
        handicaps = 2.0 * self._scale**2 * self._surprise
        owners, distances, places = nearest_capsules(self.points, capsules, handicaps)
        rows = np.empty((len(self.points), 6))
        residuals = residuals_and_rows(
            self.points, capsules, owners, distances, places, self._front, rows
        )
        return owners, residuals, rows
