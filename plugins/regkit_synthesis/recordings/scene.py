"""A mesh that moves before a depth camera, with the joints whose truth is known."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from regkit.geometry.camera import Camera
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array
from regkit_synthesis.bodies.landmarks import Landmark, placed, some_vertices
from regkit_synthesis.cameras.cameras import CAMERAS
from regkit_synthesis.cameras.raycast import RayCaster, View, stored
from regkit_synthesis.noise import DepthNoise, noise_of
from regkit_synthesis.recordings.recording import DepthRecording

FPS = 30.0


@dataclass(frozen=True)
class Sensor:
    """A depth camera.

    Attributes:
        camera: Intrinsics.
        noise: What it makes of the depth, or the standard deviation of plain Gaussian noise [m].
        depth_scale: Stored units per metre.
    """

    camera: Camera
    noise: DepthNoise | float
    depth_scale: float


SR4000 = Sensor(CAMERAS["sr4000"].camera(), 0.008, CAMERAS["sr4000"].depth_scale)
"""Size, opening angle and noise (at a few metres) of a MESA SR4000."""

SR305 = Sensor(CAMERAS["sr305"].camera(), 0.002, CAMERAS["sr305"].depth_scale)
"""An Intel RealSense SR305 at half its resolution, with a hand close before it."""


@dataclass(frozen=True)
class Scene:
    """What is to be rendered.

    Attributes:
        name: What the recording is called.
        source: Where the body and its motion come from.
        licence: Under which terms they may be used.
        mesh: The body.
        landmarks: Its joints, by name.
        bone_poses: The bone poses ``T_camera_bone`` (J, 4, 4) at a time [s].
        sensor: What looks at it.
        frames: How many images there are.
        fps: How many of them per second.
        markers: Vertices of the mesh whose truth is known beside the joints', by name.
    """

    name: str
    source: str
    licence: str
    mesh: SkinnedMesh
    landmarks: Mapping[str, Landmark]
    bone_poses: Callable[[float], Array]
    sensor: Sensor
    frames: int
    fps: float = FPS
    markers: Mapping[str, int] = field(default_factory=dict)

    @property
    def joints(self) -> tuple[str, ...]:
        """The names of the joints and of the markers."""
        return (*self.landmarks, *self.markers)

    def truth(self) -> Array:
        """Where joints and markers are in every image (T, L, 3), in the camera's frame [m]."""
        skin = some_vertices(self.mesh, np.array([*self.markers.values()], dtype=np.intp))
        return np.array([
            np.concatenate([placed(self.landmarks, self.mesh, pose), skin.posed(pose)])
            for pose in self.poses()
        ])  # fmt: skip

    def views(self) -> Iterator[View]:
        """What there is to be seen in every image.

        Raises:
            DependencyError: If Open3D cannot be loaded.
        """
        caster = RayCaster(self.sensor.camera)
        for pose in self.poses():
            yield caster.view(self.mesh.posed(pose), self.mesh.faces)

    def rendered(self, random: Callable[[int], np.random.Generator]) -> DepthRecording:
        """What the sensor measures.

        Args:
            random: Where the noise of a frame comes from.

        Raises:
            DependencyError: If Open3D cannot be loaded.
        """
        noise, scale = noise_of(self.sensor.noise), self.sensor.depth_scale
        images = [
            stored(noise.applied(view, random(frame)), scale)
            for frame, view in enumerate(self.views())
        ]
        return DepthRecording(
            name=self.name,
            fps=self.fps,
            depth_scale=scale,
            source=self.source,
            licence=self.licence,
            camera=self.sensor.camera,
            depth=np.array(images),
            joints=self.joints,
            truth=self.truth(),
        )

    def poses(self) -> list[Array]:
        """The bone poses ``T_camera_bone`` (J, 4, 4) in every image."""
        return [self.bone_poses(frame / self.fps) for frame in range(self.frames)]
