"""Landmarks: pulls the body's markers to where a detector or a motion-capture system sees them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from regkit.body import Body
from regkit.config.quantities import Length, Weight
from regkit.interfaces import CompiledJoints, JointEnergy, JointResponse, Scene, Term
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.registration.compiled_robust import loss_number
from regkit.registration.robust import Loss, Robust
from regkit.skeleton import Placement, Pose, Skeleton
from regkit.system.arrays import Array
from regkit_plugins.terms.landmarks.compiled import NEAREST, respond_joints
from regkit_plugins.terms.landmarks.table import (
    CENTRE,
    COLUMNS,
    FOCAL,
    POINT,
    SCALE,
    SEGMENT,
    TARGET,
    WEIGHT,
    landmark_table,
)


class LandmarksTerm(Term):
    """Robust distances of the body's markers to the landmarks of the same names.

    A position in space counts where there is one, else the pixel. Without landmarks the term has no
    effect.
    """

    kind: Literal["landmarks"] = "landmarks"

    weight: Weight = 0.01
    """Weight of one landmark of full confidence at its typical error, relative to the kernel's
    energy, which is a mean over all points."""
    error: Length = 0.03
    """Typical distance of a landmark in space from the template's marker [m]: the detector's error
    and the difference of what both call a joint."""
    error_px: Annotated[float, Field(ge=0.01, le=1e4)] = 4.0
    """The same for landmarks in the picture [pixels]."""
    loss: Literal["squares", "huber", "tukey", "geman_mcclure"] = "geman_mcclure"
    """Loss of the distance in units of the typical error; see the kernels' ``robust``."""

    def bind(self, scene: Scene) -> BoundLandmarks:
        """Binds the term to the landmarks of a frame."""
        table = self._table(scene.body, scene.observation)
        return BoundLandmarks(scene.body.skeleton, table[table[:, WEIGHT] > 0.0], self._loss)

    def compiled(self, body: Body, primitives: Primitives) -> CompiledJoints:
        """Returns the term as a compiled function."""
        return CompiledJoints(
            respond_joints,
            (loss_number(type(self._loss)),),
            np.zeros((len(body.markers.names), COLUMNS)),
            of_frame=lambda frame: self._table(body, frame) if frame.landmarks else None,
        )

    def _table(self, body: Body, observation: Observation) -> Array:
        return landmark_table(body, observation, self.weight, self.error, self.error_px)

    @property
    def _loss(self) -> Loss:
        """The loss of residuals in units of the typical error."""
        return Robust(loss=self.loss).kind(1.0)


@dataclass(frozen=True)
class BoundLandmarks(JointEnergy):
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
        segments = self.table[:, SEGMENT].astype(np.intp)
        carriers = placement.transforms[segments]
        offsets = self.table[:, POINT : POINT + 3, None]
        points = (carriers[:, :3, :3] @ offsets)[:, :, 0] + carriers[:, :3, 3]
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
