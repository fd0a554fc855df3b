"""Motion of a whole hand: gestures of the fingers, and an oscillating palm."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.system.arrays import Array
from regkit_synthesis.hands.gestures import Gestures

_R_GROUND_CAMERA = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
"""From the axes of a level camera (x right, y down, z forward) to the ground's (x left, y backward,
z up)."""

_R_CAMERA_PALM = np.array([[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
"""Orientation with the fingers pointing up in the image, and the palm facing the camera."""

_MIDDLE = np.array([0.0, 0.0, -0.08])
"""Centre of the hand relative to the wrist, in the axes of the palm [m]."""


@dataclass(frozen=True)
class HandMotion:
    """A right hand that makes gestures while its palm oscillates with a period of two seconds.

    Attributes:
        gestures: The motion of the fingers.
        sway: Amplitude of the palm's oscillation: 0 for none, 1 for up to 40 degrees.
        phase: Initial phase of the oscillation [rad]; at 0 and pi the palm faces the camera.
    """

    gestures: Gestures
    sway: float = 1.0
    phase: float = 0.0

    def palm(self, time: float) -> Array:
        """Returns ``T_ground_palm`` (4, 4) at ``time`` [s].

        The axes of the ground are x left, y backward, z up; its origin is the centre of the hand.
        """
        phase = np.pi * time + self.phase
        turn = vector_to_matrix(
            self.sway
            * np.array(
                [0.25 * np.sin(2.0 * phase), 0.65 * np.sin(phase), 0.3 * np.sin(phase + 0.5)]
            )
        )
        middle = self.sway * np.array(
            [0.03 * np.sin(phase), 0.01 * np.sin(2.0 * phase), 0.03 * np.sin(phase + 1.0)]
        )
        rotation = turn @ _R_CAMERA_PALM
        return rigid(_R_GROUND_CAMERA @ rotation, _R_GROUND_CAMERA @ (middle - rotation @ _MIDDLE))
