"""Views: what one of several cameras measures, and where the camera is."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Generic, TypeVar

import numpy as np

from regkit.geometry.rigid import inverse
from regkit.system.arrays import Array
from regkit.system.brief import Brief

if TYPE_CHECKING:
    from regkit.observation.frame import Frame
    from regkit.observation.observation import Observation

D = TypeVar("D", bound="Frame | Observation")


@dataclass(frozen=True)
class View(Brief, Generic[D]):
    """What one camera measures, in its own frame.

    Attributes:
        name: Name of the camera.
        T_world_camera: Pose of the camera, (4, 4) [m].
        data: The measurement in the camera's frame (x right, y down, z forward).
    """

    name: str
    T_world_camera: Array
    data: D

    @cached_property
    def to_camera(self) -> Array:
        """T_camera_world, (4, 4) [m]."""
        return inverse(self.T_world_camera)

    def moved(self, T_new_world: Array) -> View[D]:
        """Returns the view in another world.

        Args:
            T_new_world: Pose of the world in the new one, (4, 4) [m].
        """
        return replace(self, T_world_camera=T_new_world @ self.T_world_camera)


def only_view(data: D) -> View[D]:
    """Returns the view of a measurement whose camera is the world's origin."""
    return View("", np.eye(4), data)
