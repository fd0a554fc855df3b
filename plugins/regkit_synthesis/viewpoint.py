"""Viewpoints: the pose of the camera relative to a moving body."""

from __future__ import annotations

from collections.abc import Callable
from math import radians
from typing import Annotated

import numpy as np
from pydantic import Field, model_validator

from regkit.config.model import Model
from regkit.config.quantities import Angle, Coordinate, Length
from regkit.geometry.camera import Camera
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError

_R_CAMERA_GROUND = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""From x left, y backward, z up to x right, y down, z forward: a body that faces the camera."""

_MARGIN = 0.03
"""Margin on each side as a fraction of the image size, if the distance is computed."""


class Viewpoint(Model):
    """A camera that looks at the centre of the body's motion, or has a given position."""

    heading_deg: Angle = 0.0
    """Rotation of the motion from the direction to the camera, to the right of the image [deg]."""
    elevation_deg: Annotated[float, Field(ge=-90.0, le=90.0)] = 0.0
    """Downward pitch of the camera [deg]; at 90 it looks straight down."""
    roll_deg: Angle = 0.0
    """Clockwise rotation of the camera about its optical axis [deg]; the image turns
    counter-clockwise."""
    distance: Length | None = None
    """Distance from the camera to the centre of the motion [m]; by default the shortest at which
    the whole body stays in the image."""
    place: tuple[Coordinate, Coordinate, Coordinate] | None = None
    """Position of the motion's origin, instead of a ``distance``: right of, below and in front of
    the camera, in the axes of a level camera [m]; pitch and roll rotate the camera in place."""

    @model_validator(mode="after")
    def _one_of_them(self) -> Viewpoint:
        if self.place is not None and self.distance is not None:
            raise ValueError("give a distance or a place, not both")
        return self

    def placed(self, camera: Camera, surface: Callable[[], Array]) -> Array:
        """Returns ``T_camera_ground`` (4, 4).

        Args:
            camera: The camera.
            surface: Function that returns points (N, 3) [m] of the body's surface over time, in
                ground axes; it is not called if the place is given.

        Raises:
            ConfigError: If no distance is given, and the body does not fit in the image.
        """
        tilt, turn = self._tilt(), self._turn()
        if self.place is not None:
            level = rigid(_R_CAMERA_GROUND @ turn, np.array(self.place))
            return np.asarray(rigid(tilt, np.zeros(3)) @ level)
        rotation, points = tilt @ _R_CAMERA_GROUND @ turn, surface()
        middle = (points.min(axis=0) + points.max(axis=0)) / 2.0
        distance = self.distance or _shortest(camera, (points - middle) @ rotation.T)
        return rigid(rotation, np.array([0.0, 0.0, distance]) - rotation @ middle)

    def turned(self) -> Array:
        """Returns ``T_room_ground`` (4, 4), from the motion's ground axes to level ones.

        The latter face the camera: x to the right of the image, y away from the camera, z up.
        """
        return rigid(self._turn(), np.zeros(3))

    def _turn(self) -> Array:
        """Returns the rotation (3, 3) of the motion about the vertical."""
        return vector_to_matrix(np.array([0.0, 0.0, radians(self.heading_deg)]))

    def _tilt(self) -> Array:
        """Returns the rotation (3, 3) from a level camera's axes to those of this one."""
        tilt = vector_to_matrix(np.array([radians(self.elevation_deg), 0.0, 0.0]))
        roll = vector_to_matrix(np.array([0.0, 0.0, -radians(self.roll_deg)]))
        return np.asarray(roll @ tilt)


def _shortest(camera: Camera, points: Array) -> float:
    """Returns the shortest distance [m] at which all ``points`` (N, 3) are in the image."""
    across = min(camera.cx, camera.width - 1.0 - camera.cx) - _MARGIN * camera.width
    along = min(camera.cy, camera.height - 1.0 - camera.cy) - _MARGIN * camera.height
    if min(across, along) <= 0.0:
        raise ConfigError(
            f"the camera's principal point, ({camera.cx:g}, {camera.cy:g}) px, is at the border of "
            f"its {camera.width} x {camera.height} image or beyond: a body around it is never "
            "whole in the image; give view.distance"
        )
    x, y, z = points.T
    needed = np.maximum(camera.fx * np.abs(x) / across, camera.fy * np.abs(y) / along) - z
    return float(needed.max())
