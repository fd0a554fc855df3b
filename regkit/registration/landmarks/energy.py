"""The energy of landmarks: robust distances of the body's markers to where they are measured."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import prod

import numpy as np

from regkit.interfaces import JointEnergy, JointResponse
from regkit.registration.landmarks.compiled import NEAREST
from regkit.registration.landmarks.table import (
    CENTRE,
    FOCAL,
    POINT,
    SCALE,
    SEGMENT,
    TARGET,
    WEIGHT,
)
from regkit.registration.robust import Loss
from regkit.skeleton import Placement, Pose, Skeleton
from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class LandmarkEnergy(JointEnergy):
    """``sum w rho(|r| / s)`` over landmarks, with the displacement r of the marker.

    Attributes:
        skeleton: The skeleton.
        table: The measured landmarks, (L, 13).
        loss: The robust loss rho.
    """

    skeleton: Skeleton
    table: Array
    loss: Loss

    def __call__(self, pose: Pose) -> JointResponse:
        """Returns the energy, its exact gradient, and the Gauss-Newton matrix with rho's weights.

        A marker behind the camera is seen where one at ``NEAREST`` before it would be, so that the
        energy is continuous and pulls it towards the ray.
        """
        if not len(self.table):
            dofs = self.skeleton.dofs
            return JointResponse(0.0, np.zeros(dofs), np.zeros((dofs, dofs)))
        placement, count = Placement.of(self.skeleton, pose), len(self.table)
        segments, points = self.segments, self._points(placement)
        values, slopes = self._residuals(points)
        sizes, weights = np.linalg.norm(values, axis=1), self.table[:, WEIGHT]
        rows = placement.rows(
            np.repeat(segments, 3), np.repeat(points, 3, axis=0), slopes.reshape(-1, 3)
        ).reshape(count, 3, -1)
        pulls = (weights * self.loss.weights(sizes))[:, None, None] * rows
        return JointResponse(
            float(weights @ self.loss.values(sizes)),
            np.einsum("lin,li->n", pulls, values),
            np.einsum("lin,lim->nm", pulls, rows),
        )

    def sizes(self, pose: Pose) -> Array:
        """Returns the distance of each marker to its landmark in units of its error, (..., L).

        Args:
            pose: A pose; its joints may have leading dimensions for many poses at once.
        """
        points = self._points(Placement.of(self.skeleton, pose))
        count = prod(points.shape[:-2])
        many = self if count == 1 else replace(self, table=np.tile(self.table, (count, 1)))
        values, _ = many._residuals(points.reshape(-1, 3))
        return np.asarray(np.linalg.norm(values, axis=1)).reshape(points.shape[:-1])

    def places(self, pose: Pose) -> Array:
        """Returns the markers' positions in a pose, (L, 3) [m]."""
        return self._points(Placement.of(self.skeleton, pose))

    @property
    def segments(self) -> Indices:
        """Segment of each landmark's marker, (L,)."""
        return self.table[:, SEGMENT].astype(np.intp)

    def _points(self, placement: Placement) -> Array:
        """Returns the markers in the world, (..., L, 3) [m]."""
        carriers = placement.transforms[..., self.segments, :, :]
        offsets = self.table[:, POINT : POINT + 3, None]
        return np.asarray((carriers[..., :3, :3] @ offsets)[..., 0] + carriers[..., :3, 3])

    def _residuals(self, points: Array) -> tuple[Array, Array]:
        """Returns residuals (L, 3) in units of their errors, and derivatives (L, 3, 3) [1/m]."""
        table, flat = self.table, self.table[:, FOCAL] > 0.0
        seen, slopes = points.copy(), np.tile(np.eye(3), (len(points), 1, 1))
        x, y, z = points[flat].T
        before, depth = z > NEAREST, np.maximum(z, NEAREST)
        focal, centre = table[flat, FOCAL : FOCAL + 2], table[flat, CENTRE : CENTRE + 2]
        across = np.column_stack([x, y]) / depth[:, None]
        seen[flat] = np.column_stack([focal * across + centre, np.zeros(len(x))])
        projection = np.zeros((len(x), 3, 3))
        for axis in range(2):
            projection[:, axis, axis] = focal[:, axis] / depth
            projection[:, axis, 2] = -focal[:, axis] * across[:, axis] / depth * before
        slopes[flat] = projection
        scales = table[:, SCALE]
        values = (seen - table[:, TARGET : TARGET + 3]) / scales[:, None]
        return values, slopes / scales[:, None, None]
