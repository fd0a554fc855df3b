"""Rendered depth images of moving bodies."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, Literal, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from regkit.config.model import misplaced
from regkit.config.quantities import Rate, Seed
from regkit.geometry.rigid import inverse
from regkit.interfaces import Dataset, Recording
from regkit.observation import Frame, Truth, View
from regkit.sensors import CameraChoice, Sensor
from regkit.sensors.noise import NoiseChoice, noise_of
from regkit.system.arrays import Array
from regkit.system.errors import DataError, RegkitError
from regkit_plugins.datasets.depth import DepthFolders
from regkit_synthesis.recordings.cache import RecordingCache
from regkit_synthesis.recordings.defaults import completed
from regkit_synthesis.recordings.digest import digest
from regkit_synthesis.recordings.recording import DepthRecording
from regkit_synthesis.recordings.scene import Scene
from regkit_synthesis.recordings.take import Take
from regkit_synthesis.rooms import RoomChoice

Name = Annotated[str, Field(pattern=r"^\w[\w. -]*$")]


class Synthetic(Dataset):
    """Rigged bodies moved by recorded motion, ray-cast into depth, with exact joints.

    Each take becomes a recording. It is rendered on first use and stored in the user's cache
    folder, which ``regkit doctor`` names. The noise of a frame depends only on the seed, the take's
    name or ``noise_stream``, and the frame's number.
    """

    kind: Literal["synthetic"] = "synthetic"

    camera: CameraChoice = "sr4000"
    """The camera: a known one by its name, ``{file: camera.json}``, or its numbers."""
    noise: NoiseChoice | None = None
    """Depth noise: that of a known camera by its name, ``none``, a standard deviation [m], or its
    parts. By default that of ``camera`` if it is a known one, otherwise none."""
    seed: Seed = 0
    """Seed of the noise, which changes nothing else."""
    fps: Rate = 30.0
    """Frames per second."""
    room: RoomChoice = "none"
    """The room of the takes that name none: a known one by its name, ``none``, or its parts by
    their names."""
    defaults: Take = Take()
    """Fields that all takes share."""
    takes: dict[Name, Take] = Field(min_length=1)
    """The recordings by name, with the fields that differ from ``defaults``."""

    @model_validator(mode="before")
    @classmethod
    def _complete(cls, value: Any) -> Any:
        """Completes each take with the defaults."""
        if not isinstance(value, dict):
            return value
        defaults, takes = value.get("defaults"), value.get("takes")
        if not isinstance(defaults, dict) or not isinstance(takes, dict):
            return value
        whole = {
            name: completed(take, defaults) if isinstance(take, dict) else take
            for name, take in takes.items()
        }
        return {**value, "takes": whole}

    @model_validator(mode="after")
    def _all_move(self) -> Self:
        for name, take in self.takes.items():
            for location, moving in take.movings().items():
                if (reason := moving.mismatch()) is not None:
                    raise misplaced(type(self), reason, "takes", name, *location)
            if take.empty and not take.parts(self.room):
                message = "it is empty and has no room either; give it a room"
                raise misplaced(type(self), message, "takes", name)
        return self

    def found(self) -> list[Recording]:
        """Returns a recording for each take, without rendering it."""
        return [self._recording(name, take) for name, take in self.takes.items()]

    def _recording(self, name: str, take: Take) -> SyntheticRecording:
        length = min(take.frames, self.frames or take.frames)
        return SyntheticRecording(
            name=name,
            fps=self.fps,
            length=length,
            subject=take.subject_name(),
            take=take,
            dataset=self,
        )

    def sensor(self) -> Sensor:
        """Returns the camera with its noise.

        Raises:
            DataError: If the camera's file is missing or invalid.
        """
        return Sensor.of(self.camera, self.noise)


@dataclass(frozen=True)
class SyntheticRecording(Recording):
    """One take.

    Attributes:
        take: Body, motion and views.
        dataset: The dataset, with its camera.
    """

    take: Take
    dataset: Synthetic

    def prepare(self) -> None:
        """Renders the images, unless they are in the cache."""
        for view in range(len(self.take.viewpoints)):
            self.folder(view)

    def cameras(self) -> dict[str, Recording]:
        """Returns the recording of each of several cameras, in its own frame."""
        if self.take.views is None:
            return {}
        return {
            camera_name(view): DepthFolders(root=self.folder(view)).only()
            for view in range(len(self.take.views))
        }

    def frames(self) -> Iterator[Frame]:
        """Yields the images from the cache, rendered on first use."""
        if self.take.views is None:
            yield from DepthFolders(root=self.folder()).only().frames()
            return
        names, poses = zip(*self.camera_poses().items(), strict=True)
        each = (one.frames() for one in self.cameras().values())
        for index, frames in enumerate(zip(*each, strict=True)):
            views = [View(*one) for one in zip(names, poses, frames, strict=True)]
            yield Frame.of_views(views, place=f"{self.name}: instant {index}")

    def camera_poses(self) -> dict[str, Array]:
        """Returns T_world_camera (4, 4) [m] of each camera by its name."""
        grounds = [self._scene(view).T_camera_ground for view in range(len(self.take.viewpoints))]
        poses = [grounds[0] @ inverse(ground) for ground in grounds]
        # The first camera is the world, to the last bit.
        poses[0] = np.eye(4)
        return {camera_name(view): pose for view, pose in enumerate(poses)}

    def input_files(self) -> list[Path]:
        """Returns no file: the fingerprint covers what is rendered."""
        return []

    def fingerprint(self) -> str:
        """Returns the digests of the scenes, under which their images are cached."""
        return "-".join(self._key(view) for view in range(len(self.take.viewpoints)))

    def truth(self) -> Truth | None:
        """Returns the exact positions of joints and markers; None if the body is left out."""
        if self.take.empty:
            return None
        scene = self._scene()
        return Truth(scene.joints, scene.truth())

    def labels(self, view: int = 0) -> Iterator[NDArray[np.uint8]]:
        """Yields what each pixel of every frame shows, (H, W): an index in ``label_names``.

        Labels are exact: where noise moves depths between pixels, they differ at outlines.

        Args:
            view: Index of the camera.
        """
        return self._scene(view).labels()

    def label_names(self) -> tuple[str, ...]:
        """Returns the names of the labels: nothing, the body, and the parts of the room."""
        return ("nothing", "body", *self.take.parts(self.dataset.room))

    def folder(self, view: int = 0) -> Path:
        """Returns the depth folder in the cache, rendered on first use.

        Args:
            view: Index of the camera.
        """
        key = self._key(view)
        try:
            cache = RecordingCache.of_user()
            return cache.entry(key, lambda: self._rendered(self._scene(view), view))
        except RegkitError as error:
            raise self._located(error) from None

    def _key(self, view: int) -> str:
        """Returns the digest of a scene as this recording renders it."""
        if view not in self._keys:
            stream = self.take.noise_stream_of(view)
            self._keys[view] = digest(self._scene(view), self.dataset.seed, stream)
        return self._keys[view]

    @cached_property
    def _keys(self) -> dict[int, str]:
        """The digests that are known, by the index of the camera."""
        return {}

    def _scene(self, view: int = 0) -> Scene:
        try:
            sensor = self.dataset.sensor()
            if self.take.noise is not None:
                sensor = replace(sensor, noise=noise_of(self.take.noise))
            room = self.dataset.room
            return self.take.scene(self.name, sensor, self.fps, self.length, room, view)
        except RegkitError as error:
            raise self._located(error) from None

    def _rendered(self, scene: Scene, view: int) -> DepthRecording:
        """Returns the rendered scene.

        Raises:
            DataError: If a frame does not show the body, or in a room no frame does.
        """
        if scene.hides_body():
            raise DataError(
                "no frame shows the body: the room hides it, or it is outside of the image; change "
                "the room or the view (with a negative elevation_deg the camera may be below the "
                "floor)"
            )
        recording = scene.rendered(self.take.random(self.name, self.dataset.seed, view))
        blank = np.flatnonzero(~recording.depth.any(axis=(1, 2)))
        if len(blank) and not scene.empty:
            raise DataError(
                f"the image of frame {blank[0]} does not show the body; change view.distance, or "
                "leave it out",
            )
        return recording

    def _located(self, error: RegkitError) -> RegkitError:
        return type(error)(
            f"this take cannot be rendered: {error}", place=f"dataset.takes.{self.name}"
        )


def camera_name(view: int) -> str:
    """Returns the name of a camera from its index."""
    return f"camera_{view}"
