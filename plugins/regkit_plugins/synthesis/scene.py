"""A mesh that moves before a depth camera, with the joints whose truth is known."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from regkit.arrays import Array
from regkit.camera import Camera
from regkit.skinned_mesh import SkinnedMesh
from regkit_plugins.synthesis.landmarks import Landmark, placed
from regkit_plugins.synthesis.raycast import measured, ray_cast
from regkit_plugins.synthesis.sequence import DepthSequence

FPS = 30.0


@dataclass(frozen=True)
class Sensor:
    """A depth camera.

    Attributes:
        camera: Intrinsics.
        noise: Standard deviation of the depth [m].
        depth_scale: Stored units per metre.
    """

    camera: Camera
    noise: float
    depth_scale: float


SR4000 = Sensor(Camera(width=176, height=144, fx=231.0, fy=231.0, cx=87.5, cy=71.5), 0.008, 1000.0)
"""Size, opening angle and noise (at a few metres) of a MESA SR4000."""

SR305 = Sensor(
    Camera(width=320, height=240, fx=238.0, fy=238.0, cx=159.5, cy=119.5), 0.002, 10000.0
)
"""An Intel RealSense SR305 at half its resolution, with a hand close before it."""


@dataclass(frozen=True)
class Scene:
    """What is to be rendered.

    Attributes:
        name: What the sequence is called.
        source: Where the body and its motion come from.
        licence: Under which terms they may be used.
        mesh: The body.
        landmarks: Its joints, by name.
        bone_poses: The bone poses ``T_camera_bone`` (J, 4, 4) at a time [s].
        sensor: What looks at it.
        frames: How many images there are, ``FPS`` of them per second.
    """

    name: str
    source: str
    licence: str
    mesh: SkinnedMesh
    landmarks: Mapping[str, Landmark]
    bone_poses: Callable[[float], Array]
    sensor: Sensor
    frames: int

    def truth(self) -> Array:
        """Where the joints are in every image (T, L, 3), in the camera's frame [m]."""
        return np.array([placed(self.landmarks, self.mesh, pose) for pose in self._poses()])

    def rendered(self, random: np.random.Generator) -> DepthSequence:
        """What the sensor measures, with noise from ``random``.

        Raises:
            DependencyError: If Open3D cannot be loaded.
        """
        camera, noise, scale = self.sensor.camera, self.sensor.noise, self.sensor.depth_scale
        images = [
            measured(ray_cast(self.mesh.posed(pose), self.mesh.faces, camera), noise, scale, random)
            for pose in self._poses()
        ]
        return DepthSequence(
            name=self.name,
            fps=FPS,
            depth_scale=scale,
            source=self.source,
            licence=self.licence,
            camera=camera,
            depth=np.array(images),
            joints=tuple(self.landmarks),
            truth=self.truth(),
        )

    def _poses(self) -> list[Array]:
        return [self.bone_poses(frame / FPS) for frame in range(self.frames)]
