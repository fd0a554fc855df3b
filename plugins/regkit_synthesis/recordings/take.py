"""Takes: a body, its motion, and the viewpoint of the camera."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Annotated, Self

import numpy as np
from pydantic import Field, model_validator

from regkit.config.model import Model
from regkit.sensors import Sensor
from regkit.sensors.noise import NoiseChoice
from regkit.system.arrays import Array
from regkit_synthesis.bodies.bodies import ShippedBody
from regkit_synthesis.bodies.choice import chosen_body, chosen_motion
from regkit_synthesis.bodies.hand import ShippedHand
from regkit_synthesis.bodies.landmarks import some_vertices
from regkit_synthesis.moving import Moved, Moving, MovingPart, joined_bodies
from regkit_synthesis.recordings.scene import Scene
from regkit_synthesis.rooms import Part, Region, RoomChoice, RoomName, Surface, room_of
from regkit_synthesis.viewpoint import Viewpoint

PartName = Annotated[str, Field(pattern=r"^[A-Za-z]\w*$")]
"""The name of one of several bodies."""

_SPARSE = 8
"""Stride of the vertices that sample the body's extent, some centimetres apart."""


class Take(Moving):
    """The description of one rendered recording."""

    bodies: Annotated[dict[PartName, MovingPart], Field(min_length=1, max_length=16)] | None = None
    """Several bodies by name, instead of ``body``, ``motion``, ``course`` and ``markers``. The
    names of their joints begin with theirs: ``left_wrist`` is the wrist of ``left``."""
    view: Viewpoint = Viewpoint()
    """The viewpoint of the camera."""
    views: Annotated[tuple[Viewpoint, ...], Field(min_length=1, max_length=16)] | None = None
    """The viewpoints of several cameras, instead of ``view``. The frame of the first camera is the
    world, in which truth and results are; the room stands as that camera sees it."""
    frames: Annotated[int, Field(ge=1, le=100_000)] = 60
    """Number of frames."""
    subject: str | None = None
    """Name of the subject, for experiments with a template per subject; by default the name of a
    shipped body."""
    noise: NoiseChoice | None = None
    """Noise of this take; by default that of the dataset."""
    noise_stream: str | None = None
    """Name of one random stream for the noise of all frames; by default each frame has its own
    stream, derived from the take's name."""
    room: RoomChoice | None = None
    """The room around the body: a known one by its name, ``none``, or its parts by their names; by
    default that of the dataset."""
    empty: bool = False
    """Whether to leave the body out. Camera and room are as they would be with it, so this renders
    the background of a take."""
    difficulty: str = ""
    """A note on the difficulty of the take."""

    @model_validator(mode="after")
    def _one_or_several(self) -> Self:
        if self.views is not None and "view" in self.model_fields_set:
            raise ValueError("give view or views, not both")
        alone = [field for field in Moving.model_fields if field in self.model_fields_set]
        if self.bodies is not None and alone:
            raise ValueError(f"give bodies or {alone[0]}, not both")
        return self

    def movings(self) -> dict[tuple[str, ...], Moving]:
        """Returns the bodies that move, by their place among the fields."""
        if self.bodies is None:
            return {(): self}
        return {("bodies", name): part for name, part in self.bodies.items()}

    @property
    def viewpoints(self) -> tuple[Viewpoint, ...]:
        """The viewpoints of all cameras."""
        return (self.view,) if self.views is None else self.views

    def subject_name(self) -> str | None:
        """Returns the name of the subject, if it has one."""
        body = self.body
        if (
            self.subject is None
            and self.bodies is None
            and isinstance(body, (str, ShippedBody, ShippedHand))
        ):
            return body if isinstance(body, str) else body.name
        return self.subject

    def parts(self, room: RoomName | Mapping[str, Part]) -> Mapping[str, Part]:
        """Returns the parts of its room, by name.

        Args:
            room: The room of a take that names none.
        """
        return room_of(room if self.room is None else self.room)

    def random(self, name: str, seed: int, view: int = 0) -> Callable[[int], np.random.Generator]:
        """Returns the random generator of each frame's noise, for the recording ``name``.

        The returned function must be called for the frames in order.

        Args:
            name: Name of the recording.
            seed: Seed of the dataset.
            view: Index of the camera.
        """
        stream_name = self.noise_stream_of(view)
        if stream_name is None:
            name = camera_of(name, view)
            return lambda frame: np.random.default_rng([seed, frame, *name.encode()])
        stream = np.random.default_rng([seed, *stream_name.encode()])
        return lambda frame: stream

    def noise_stream_of(self, view: int) -> str | None:
        """Returns the name of the random stream of one of the cameras; None without any."""
        return None if self.noise_stream is None else camera_of(self.noise_stream, view)

    def scene(
        self,
        name: str,
        sensor: Sensor,
        fps: float,
        frames: int,
        room: RoomName | Mapping[str, Part] = "none",
        view: int = 0,
    ) -> Scene:
        """Returns the scene to render.

        Args:
            name: Name of the recording.
            sensor: The depth camera.
            fps: Frames per second.
            frames: Number of frames; the camera's pose is that for all frames of the take.
            room: The room of a take that names none.
            view: Index of the camera.

        Raises:
            RegkitError: If a file is missing or invalid, or the motion does not fit the body.
        """
        moved = self.moved() if self.bodies is None else joined_bodies(self.bodies)

        def surface() -> Array:
            skin = some_vertices(moved.mesh, np.arange(0, len(moved.mesh.vertices), _SPARSE))
            times = np.arange(self.frames) / fps
            return np.concatenate([skin.posed(moved.bone_poses(time)) for time in times])

        T_camera_ground = self.viewpoints[view].placed(sensor.camera, surface)
        return Scene(
            name=camera_of(name, view),
            source=f"Rendered by regkit: {self._told()}",
            licence="That of the body and of the motion",
            mesh=moved.mesh,
            landmarks=moved.landmarks,
            bone_poses=lambda time: np.asarray(T_camera_ground @ moved.bone_poses(time)),
            sensor=sensor,
            frames=frames,
            fps=fps,
            markers=moved.markers,
            room=self._surroundings(self.parts(room), moved, fps, T_camera_ground),
            empty=self.empty,
            T_camera_ground=T_camera_ground,
        )

    def _told(self) -> str:
        """Returns the bodies and their motions in words."""
        if self.bodies is None:
            return _told(self)
        return "; ".join(f"{name}: {_told(part)}" for name, part in self.bodies.items())

    def _surroundings(
        self,
        parts: Mapping[str, Part],
        moved: Moved,
        fps: float,
        T_camera_ground: Array,
    ) -> dict[str, Surface]:
        """Returns the parts of a room in camera axes, placed beside the region of the motion."""
        if not parts:
            return {}
        T_room_ground, times = self.viewpoints[0].turned(), np.arange(self.frames) / fps
        T_camera_room = T_camera_ground @ np.linalg.inv(T_room_ground)
        region = Region.around(
            moved.mesh.posed(T_room_ground @ moved.bone_poses(time)) for time in times
        )
        return {
            name: part.surface(region, times).moved(T_camera_room) for name, part in parts.items()
        }


def camera_of(name: str, view: int) -> str:
    """Returns a recording's name for one of its cameras; the first has the name itself."""
    return name if view == 0 else f"{name}-{view}"


def _told(moving: Moving) -> str:
    """Returns a body and its motion in words: what of it was given."""
    told = _given(chosen_body(moving.body))
    if moving.motion is not None:
        told += f", moved by {_given(chosen_motion(moving.motion))}"
    return told if moving.course is None else f"{told}, carried along a course"


def _given(config: Model) -> str:
    given = config.model_dump(mode="json", exclude_defaults=True)
    return ", ".join(f"{field} {value}" for field, value in given.items())
