"""Cameras in the world: where each of several is, and what it sees at most."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from regkit.geometry.camera import Camera
from regkit.geometry.rigid import transformed
from regkit.system.arrays import Array

if TYPE_CHECKING:
    from regkit.observation.view import View

HALF = 0.5
"""Half the width of the picture at one metre, of a camera whose lens is unknown."""


@dataclass(frozen=True)
class PlacedCamera:
    """A camera in the world.

    Attributes:
        name: Its name.
        T_world_camera: Its pose, (4, 4) [m].
        camera: Its lens, if it is known.
    """

    name: str
    T_world_camera: Array
    camera: Camera | None = None

    @classmethod
    def of_views(cls, views: Iterable[View[Any]]) -> tuple[Self, ...]:
        """Returns the cameras of views; none without any."""
        return tuple(cls(view.name, view.T_world_camera, view.data.camera) for view in views)

    def corners(self) -> Array:
        """Returns where the rays through the picture's corners are at one metre, (4, 3) [m]."""
        sides = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
        place = HALF * sides
        if self.camera is not None:
            lens = self.camera
            pixels = 0.5 * (sides + 1.0) * [lens.width, lens.height] - 0.5
            place = (pixels - [lens.cx, lens.cy]) / [lens.fx, lens.fy]
        return transformed(self.T_world_camera, np.column_stack([place, np.ones(4)]))
