"""The motion of a whole hand: gestures of its fingers, and a palm that sways."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.system.arrays import Array
from regkit_synthesis.hands.gestures import Gestures

_R_GROUND_CAMERA = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
"""From x right, y down, z forward of a level camera to x left, y backward, z up of what it sees."""

_R_CAMERA_PALM = np.array([[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
"""The fingers point up in the image, and the palm looks into the camera."""

_MIDDLE = np.array([0.0, 0.0, -0.08])
"""The middle of the hand in the palm's axes, from the wrist [m]."""


@dataclass(frozen=True)
class HandMotion:
    """A right hand that makes gestures while its palm sways, once in two seconds.

    Attributes:
        gestures: What the fingers do.
        sway: How much the palm sways: 0 holds it still, 1 turns it by up to 40 degrees.
        phase: Where in its sway the palm begins [rad]; at 0 and pi it looks into the camera.
    """

    gestures: Gestures
    sway: float = 1.0
    phase: float = 0.0

    def palm(self, time: float) -> Array:
        """``T_ground_palm`` (4, 4) at ``time`` [s]: it sways about the middle of the hand.

        The ground's axes are x left, y backward, z up; its origin is the middle of the hand.
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
