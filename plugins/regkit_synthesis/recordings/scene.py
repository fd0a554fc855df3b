"""Scenes: a moving mesh in front of a depth camera, with ground-truth joints."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.sensors import CAMERAS, RayCaster, Sensor, View, nearest
from regkit.system.arrays import Array
from regkit.system.progress import steps
from regkit_synthesis.bodies.landmarks import Landmark, placed, some_vertices
from regkit_synthesis.recordings.recording import DepthRecording
from regkit_synthesis.rooms.surface import Surface

FPS = 30.0

BODY = 1
"""Label of the pixels that show the body."""


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
        room: The parts of the room in camera axes, by name.
        empty: Whether the body is left out.
        T_camera_ground: Pose of the ground in the camera's frame, (4, 4) [m].
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
    room: Mapping[str, Surface] = field(default_factory=dict)
    empty: bool = False
    T_camera_ground: Array = field(default_factory=lambda: np.eye(4))

    @property
    def joints(self) -> tuple[str, ...]:
        """Returns the names of the joints and markers; none if the body is left out."""
        return () if self.empty else (*self.landmarks, *self.markers)

    def truth(self) -> Array:
        """Returns positions (T, L, 3) [m] of joints and markers in every frame, in camera axes."""
        if self.empty:
            return np.zeros((self.frames, 0, 3))
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
        for layers in self._layers():
            yield nearest(layers)[0]

    def labels(self) -> Iterator[NDArray[np.uint8]]:
        """Yields what each pixel of every frame shows, (H, W), before noise.

        0 is nothing, ``BODY`` the body, and the numbers from there on the parts of the room in
        their order.

        Raises:
            DependencyError: If Open3D cannot be loaded.
        """
        for layers in self._layers():
            yield (nearest(layers)[1] + BODY).astype(np.uint8)

    def hides_body(self) -> bool:
        """Returns whether there is a room, and no frame shows the body that should be in it.

        Raises:
            DependencyError: If Open3D cannot be loaded.
        """
        if not self.room or self.empty:
            return False
        return not any((labels == BODY).any() for labels in self.labels())

    def _layers(self) -> Iterator[list[View]]:
        """Yields the views of the body and of each part of the room in every frame."""
        camera = self.sensor.camera
        caster, absent = RayCaster(camera), View.of_nothing((camera.height, camera.width))

        def seen(part: Surface, frame: int) -> View:
            return caster.view(part.vertices(frame / self.fps), part.faces)

        still = {name: seen(part, 0) for name, part in self.room.items() if part.still}
        for frame, pose in enumerate(self.poses()):
            body = absent if self.empty else caster.view(self.mesh.posed(pose), self.mesh.faces)
            parts = (still.get(name) or seen(part, frame) for name, part in self.room.items())
            yield [body, *parts]

    def rendered(self, random: Callable[[int], np.random.Generator]) -> DepthRecording:
        """Returns the recording as measured by the sensor.

        Args:
            random: Function that returns the random generator of a frame's noise.

        Raises:
            DependencyError: If Open3D cannot be loaded.
        """
        what = f"rendering {self.name}"
        images = [
            self.sensor.image(view, random(frame))
            for frame, view in enumerate(steps(self.views(), what, self.frames))
        ]
        return DepthRecording(
            name=self.name,
            fps=self.fps,
            depth_scale=self.sensor.depth_scale,
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
