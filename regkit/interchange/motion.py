"""A tracked motion, as it leaves regkit."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array

UPRIGHT_CAMERA = np.diag([1.0, -1.0, -1.0])
"""``R_scene_camera``: a camera's y points down and z forward, a scene's y up and z backward."""


@dataclass(frozen=True)
class TrackedMotion:
    """Where a body's segments were in T frames.

    Attributes:
        name: What the motion is called.
        body: The body, at its size.
        transforms: ``T_camera_segment``, (T, S, 4, 4) [m].
        fps: Frames per second.
        skin: Its mesh at its size, whose bones are named as segments are, if it has one.
    """

    name: str
    body: Body
    transforms: Array
    fps: float
    skin: SkinnedMesh | None

    @property
    def times(self) -> Array:
        """The time of each frame, (T,) [s], from zero."""
        return np.arange(len(self.transforms)) / self.fps
