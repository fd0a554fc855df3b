"""The interface of the parts of a room."""

from __future__ import annotations

from abc import ABC, abstractmethod

from regkit.config.model import Model
from regkit.config.quantities import Angle, Coordinate
from regkit.system.arrays import Array
from regkit_synthesis.rooms.region import Region, Side
from regkit_synthesis.rooms.surface import Surface


class Part(Model, ABC):
    """A part of a room, in YAML."""

    @abstractmethod
    def surface(self, region: Region, times: Array) -> Surface:
        """Returns the surface in room axes.

        Args:
            region: The region that the body covers, on the room's ground.
            times: The times (T,) [s] of the take's frames.

        Raises:
            RegkitError: If a file that it names is missing or invalid.
        """


class Standing(Part, ABC):
    """A part that stands on the ground beside the region that the body covers."""

    side: Side = "back"
    """The side of the body at which it stands, as the camera sees it: behind, before, left or
    right of the region that the body covers over time."""
    distance: Coordinate = 0.5
    """Gap between that region and the part [m]; negative if they overlap."""
    shift: Coordinate = 0.0
    """Displacement along that side from its middle [m]: to the right of the image for ``back`` and
    ``front``, away from the camera for ``left`` and ``right``."""
    heading_deg: Angle = 0.0
    """Rotation about the vertical [deg]: at 0 it faces the camera, and turns to the right of the
    image."""
