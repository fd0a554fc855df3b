"""Training samples: depth frames of a template's own surface in known poses."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np

from regkit.body import Body
from regkit.geometry.lens import Lens
from regkit.geometry.rigid import transformed
from regkit.geometry.surface import SkinnedSurface
from regkit.interfaces import Preprocessor
from regkit.observation import Frame, Observation
from regkit.sensors import CameraChoice, RayCaster, Sensor
from regkit.sensors.noise import NoiseChoice
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.brief import Brief
from regkit.system.errors import ConfigError
from regkit.tuning.samples.holes import opening
from regkit.tuning.samples.motion import Movement
from regkit.tuning.samples.surface import rendered_surface
from regkit.tuning.samples.transfer import PoseTransfer
from regkit.tuning.samples.views import Views


@dataclass(frozen=True)
class Sample(Brief):
    """L successive frames of a moving body, and where it truly is.

    Attributes:
        observations: What a preprocessor makes of each depth image, (L,).
        poses: True poses of the rendered body in the camera frame, (L,).
        starts: Poses of the tuned body with the same root and joint angles, (L,).
        names: Names of the M markers that both bodies have.
        markers: Their true positions in the camera frame (x right, y down, z forward), those of
            the rendered body, (L, M, 3) [m].
    """

    observations: tuple[Observation, ...]
    poses: tuple[Pose, ...]
    starts: tuple[Pose, ...]
    names: tuple[str, ...]
    markers: Array


class _View(NamedTuple):
    """A motion before the camera.

    Attributes:
        moved: Poses of the tuned body, (L,).
        shown: Poses of the rendered body, (L,).
        placed: T_body_segment of the rendered body, (L, S, 4, 4).
        T_camera_body: Where the body is, (4, 4).
        vertices: Vertices of the rendered surface in the camera frame, (L, V, 3) [m].
        noises: Source of the noise of each frame, (L,).
    """

    moved: list[Pose]
    shown: list[Pose]
    placed: Array
    T_camera_body: Array
    vertices: Array
    noises: list[np.random.Generator]


@dataclass(frozen=True)
class Sampler:
    """Renders samples of a body that moves at random before a depth camera.

    A sample depends on the seed and its index alone, so that processes can share the work.

    Attributes:
        body: The body to tune, which has the joint limits and stances of the motion.
        preprocessor: What makes observations of frames; without one there are frames only.
        rendered: The body that the camera sees, by default the same one; another one has the same
            joints, but other lengths, another surface, or another size.
        camera: The camera.
        noise: Its noise; by default that of a known camera, and none of any other.
        frames: Number L of frames of a sample.
        fastest: Greatest displacement of any part from one frame to the next, in sizes of the body.
        views: Where the camera is.
        seed: Seed of the motions, views and noise.
    """

    body: Body
    preprocessor: Preprocessor | None = None
    rendered: Body | None = None
    camera: CameraChoice = "sr4000"
    noise: NoiseChoice | None = None
    frames: int = 6
    fastest: float = 0.07
    views: Views = field(default_factory=Views)
    seed: int = 0

    def __post_init__(self) -> None:
        """Validates the bodies and the camera.

        Raises:
            ConfigError: If the body has no capsules, or the rendered one has other joints, or no
                marker of the same name.
            DataError: If the camera's file is missing or invalid.
        """
        for body in (self.body, self._shown):
            if not len(body.capsules):
                raise ConfigError(
                    f"the template '{body.name}' has no capsules, by which its parts keep apart; "
                    "give its segments capsules"
                )
        _ = self._transfer, self.names, self._caster

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names of the M markers that both bodies have."""
        ours, shown = self.body.markers.names, self._shown
        shared = tuple(name for name in ours if name in shown.markers.names)
        if not shared:
            raise ConfigError(
                f"the templates '{self.body.name}' and '{shown.name}' have no marker of the same "
                "name, by which a pose could be compared with the true one"
            )
        return shared

    def sample(self, index: int) -> Sample:
        """Returns a sample; the same one for the same index and seed, in any order.

        Args:
            index: Its number, from 0 on.

        Raises:
            ConfigError: If every motion intersects itself, or the body fits into no image.
            DataError: If an image shows too little of the body for the preprocessor.
            DependencyError: If Open3D cannot be loaded.
        """
        assert self.preprocessor is not None
        view = self._view(index)
        own = self._shown.markers
        rows = [own.names.index(name) for name in self.names]
        return Sample(
            tuple(self.preprocessor.preprocess(frame) for frame in self._frames(view)),
            _moved(view.T_camera_body, view.shown),
            _moved(view.T_camera_body, view.moved),
            self.names,
            own.place(view.T_camera_body @ view.placed)[:, rows],
        )

    def frame(self, index: int) -> Frame:
        """Returns the first frame of a sample."""
        return next(self._frames(self._view(index)))

    def _view(self, index: int) -> _View:
        """Returns a motion, and where the camera is."""
        motion, view, *noises = np.random.default_rng([self.seed, index]).spawn(2 + self.frames)
        moved = self._movement.sampled(motion, self.frames)
        shown = [self._transfer.pose(pose) for pose in moved]
        placed = np.array([self._shown.place(pose).transforms for pose in shown])
        vertices = np.array([self._surface.place(transforms) for transforms in placed])
        T_camera_body = self.views.sampled(
            view, self._sensor.camera, vertices, self._shown, self._opening
        )
        seen = transformed(T_camera_body, vertices.reshape(-1, 3)).reshape(vertices.shape)
        return _View(moved, shown, placed, T_camera_body, seen, noises)

    def _frames(self, view: _View) -> Iterator[Frame]:
        """Yields frames, each stored and read back as a camera's."""
        sensor = self._sensor
        for vertices, noise in zip(view.vertices, view.noises, strict=True):
            seen = self._caster.view(vertices, self._surface.faces)
            depth = sensor.image(seen, noise) / sensor.depth_scale
            yield Frame.of_image(depth, Lens(sensor.camera))

    @property
    def _shown(self) -> Body:
        return self.body if self.rendered is None else self.rendered

    @cached_property
    def _movement(self) -> Movement:
        return Movement(self.body, self.fastest)

    @cached_property
    def _transfer(self) -> PoseTransfer:
        return PoseTransfer.between(self.body, self._shown)

    @cached_property
    def _surface(self) -> SkinnedSurface:
        return rendered_surface(self._shown)

    @cached_property
    def _opening(self) -> Array | None:
        return opening(self._shown)

    @cached_property
    def _sensor(self) -> Sensor:
        return Sensor.of(self.camera, self.noise)

    @cached_property
    def _caster(self) -> RayCaster:
        return RayCaster(self._sensor.camera)


def _moved(transform: Array, poses: list[Pose]) -> tuple[Pose, ...]:
    """Returns poses after a rigid motion of the whole body."""
    return tuple(Pose(transform @ pose.root, pose.balls, pose.hinges) for pose in poses)
