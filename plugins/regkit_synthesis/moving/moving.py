"""The YAML form of a body that moves."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Annotated

import numpy as np
from pydantic import Field

from regkit.config.model import Model
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError
from regkit_synthesis.bodies.choice import Body, Motion, chosen_body, chosen_motion
from regkit_synthesis.bodies.hand import ShippedHand
from regkit_synthesis.bodies.landmarks import Landmark
from regkit_synthesis.bodies.objects import RigidConfig
from regkit_synthesis.hands.config import GesturesConfig
from regkit_synthesis.moving.course import Course, carried
from regkit_synthesis.moving.moved import Moved


def _still(time: float) -> Array:
    """Returns the pose of a rigid object's bone (1, 4, 4), the same at any time."""
    return np.eye(4)[None]


class Moving(Model):
    """A body with its motion, and where it is carried."""

    body: Body = "average"
    """The body: ``average``, ``small`` or ``tall``, or a body, hand or object by its ``kind``."""
    motion: Motion | None = None
    """The motion: the name of a shipped clip, or a motion by its ``kind``. A rigid object has
    none."""
    course: Course | None = None
    """Places through which the body is carried as a whole, besides its motion."""
    markers: dict[str, Annotated[int, Field(ge=0, le=2**31)]] = Field(default_factory=dict)
    """Additional markers, by name: vertices of the mesh whose true positions are recorded."""

    def mismatch(self) -> str | None:
        """Returns in words why the motion is none of the body's; None if it is one."""
        if isinstance(self.body, RigidConfig):
            moves = self.motion is not None
            return "a rigid object has no motion of its own; give it a course" if moves else None
        if self.motion is None:
            return "it has no motion, and the defaults have none either"
        if isinstance(self.body, ShippedHand) != isinstance(self.motion, GesturesConfig):
            return "gestures are motions of a hand only"
        return None

    def moved(self) -> Moved:
        """Returns the body, moved.

        Raises:
            RegkitError: If a file is missing or invalid, or the motion does not fit the body.
        """
        body = chosen_body(self.body).body()
        for marker, vertex in self.markers.items():
            _check_marker(marker, vertex, body.landmarks, len(body.mesh.vertices))
        if (reason := self.mismatch()) is not None:
            raise ConfigError(reason)
        poses = _still if self.motion is None else body.moved_by(chosen_motion(self.motion))
        moved = Moved(body.mesh, body.landmarks, poses, self.markers)
        return moved if self.course is None else moved.along(partial(carried, self.course))


def _check_marker(marker: str, vertex: int, joints: Mapping[str, Landmark], vertices: int) -> None:
    """Refuses a marker that has a joint's name, or is none of the vertices."""
    if marker in joints:
        raise ConfigError(f"a marker cannot be called '{marker}', for this is a joint")
    if vertex >= vertices:
        raise ConfigError(
            f"marker '{marker}' is vertex {vertex}, but the body has {vertices}, from 0 on"
        )
