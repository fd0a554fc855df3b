"""Tracked motion in the form in which it is exported."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array

UPRIGHT_CAMERA = np.diag([1.0, -1.0, -1.0])
"""``R_scene_camera``: the camera has y down and z forward, a scene y up and z backward."""


@dataclass(frozen=True)
class TrackedMotion:
    """The motion of a body over T frames.

    Attributes:
        name: Name of the motion.
        body: The body at its size.
        transforms: ``T_camera_segment``, (T, S, 4, 4) [m].
        hinges: Angle of each hinge, (T, n_hinge) [rad].
        fps: Frames per second.
        skin: The body's mesh at its size, with bones named like segments; None if there is none.
        verdicts: Whether the body was found in each frame, (T,); None if unknown.
    """

    name: str
    body: Body
    transforms: Array
    hinges: Array
    fps: float
    skin: SkinnedMesh | None
    verdicts: tuple[str, ...] | None = None

    @property
    def times(self) -> Array:
        """The time of each frame, (T,) [s], starting at zero."""
        return np.arange(len(self.transforms)) / self.fps
