"""Scenes: a moving mesh in front of a depth camera, with ground-truth joints."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from regkit.geometry.camera import Camera
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array
from regkit.system.progress import steps
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
        noise: Noise model, or the standard deviation of constant Gaussian noise [m].
        depth_scale: Stored units per metre.
    """

    camera: Camera
    noise: DepthNoise | float
    depth_scale: float


SR4000 = Sensor(CAMERAS["sr4000"].camera(), 0.008, CAMERAS["sr4000"].depth_scale)
"""A MESA SR4000: size, field of view, and noise at a few metres."""

SR305 = Sensor(CAMERAS["sr305"].camera(), 0.002, CAMERAS["sr305"].depth_scale)
"""An Intel RealSense SR305 at half its resolution, with a hand at close range."""


@dataclass(frozen=True)
class Scene:
    """A scene to render.

    Attributes:
        name: Name of the recording.
        source: Source of the body and its motion.
        licence: Licence of the body and its motion.
        mesh: The mesh of the body.
        landmarks: Joints of the body, by name.
        bone_poses: Function from a time [s] to bone poses ``T_camera_bone`` (J, 4, 4).
        sensor: The depth camera.
        frames: Number of frames.
        fps: Frames per second.
        markers: Additional markers, by name: vertices of the mesh with recorded positions.
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
        """Returns the names of the joints and markers."""
        return (*self.landmarks, *self.markers)

    def truth(self) -> Array:
        """Returns positions (T, L, 3) [m] of joints and markers in every frame, in camera axes."""
        skin = some_vertices(self.mesh, np.array([*self.markers.values()], dtype=np.intp))
        return np.array([
            np.concatenate([placed(self.landmarks, self.mesh, pose), skin.posed(pose)])
            for pose in self.poses()
        ])  # fmt: skip

    def views(self) -> Iterator[View]:
        """Yields the exact view of every frame.

        Raises:
            DependencyError: If Open3D cannot be loaded.
        """
        caster = RayCaster(self.sensor.camera)
        for pose in self.poses():
            yield caster.view(self.mesh.posed(pose), self.mesh.faces)

    def rendered(self, random: Callable[[int], np.random.Generator]) -> DepthRecording:
        """Returns the recording as measured by the sensor.

        Args:
            random: Function that returns the random generator of a frame's noise.

        Raises:
            DependencyError: If Open3D cannot be loaded.
        """
        noise, scale = noise_of(self.sensor.noise), self.sensor.depth_scale
        what = f"rendering {self.name}"
        images = [
            stored(noise.applied(view, random(frame)), scale)
            for frame, view in enumerate(steps(self.views(), what, self.frames))
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
        """Returns the bone poses ``T_camera_bone`` (J, 4, 4) of every frame."""
        return [self.bone_poses(frame / self.fps) for frame in range(self.frames)]
