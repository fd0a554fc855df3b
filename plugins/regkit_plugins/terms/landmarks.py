"""Landmarks: pulls the body's markers to where a detector or a motion-capture system sees them."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from regkit.body import Body
from regkit.config.quantities import Length, Weight
from regkit.interfaces import CompiledJoints, Scene, Term
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.registration.compiled_robust import loss_number
from regkit.registration.landmarks import (
    COLUMNS,
    WEIGHT,
    LandmarkEnergy,
    landmark_table,
    respond_joints,
)
from regkit.registration.robust import Loss, Robust
from regkit.system.arrays import Array


class LandmarksTerm(Term):
    """Robust distances of the body's markers to the landmarks of the same names.

    A position in space counts where there is one, else the pixel. Without landmarks the term has no
    effect.
    """

    kind: Literal["landmarks"] = "landmarks"
    reads_landmarks: ClassVar[bool] = True

    weight: Weight = 0.01
    """Weight of one landmark of full confidence at its typical error, relative to the kernel's
    energy, which is a mean over all points."""
    error: Length | None = None
    """Typical distance of a landmark in space from the template's marker [m]: the detector's error
    and the difference of what both call a joint. By default 1.8 % of the body's size: 3 cm of a
    person, 3 mm of a hand."""
    error_px: Annotated[float, Field(ge=0.01, le=1e4)] | None = None
    """The same for landmarks in the picture [pixels]; by default what ``error`` is at the distance
    of the data, but at least 2."""
    loss: Literal["squares", "huber", "tukey", "geman_mcclure"] = "geman_mcclure"
    """Loss of the distance in units of the typical error, as of the kernels' ``robust``."""

    def bind(self, scene: Scene) -> LandmarkEnergy:
        """Binds the term to the landmarks of a frame."""
        table = self._table(scene.body, scene.observation)
        return LandmarkEnergy(scene.body.skeleton, table[table[:, WEIGHT] > 0.0], self._loss)

    def compiled(self, body: Body, primitives: Primitives) -> CompiledJoints:
        """Returns the term as a compiled function."""
        return CompiledJoints(
            respond_joints,
            (loss_number(type(self._loss)),),
            np.zeros((len(body.markers.names), COLUMNS)),
            of_frame=lambda frame: self._table(body, frame) if frame.landmarks else None,
        )

    def _table(self, body: Body, observation: Observation) -> Array:
        return landmark_table(
            body, observation, weight=self.weight, error=self.error, error_px=self.error_px
        )

    @property
    def _loss(self) -> Loss:
        """The loss of residuals in units of the typical error."""
        return Robust(loss=self.loss).kind(1.0)
