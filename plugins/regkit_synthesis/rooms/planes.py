"""Floors and walls."""

from __future__ import annotations

from typing import Literal

import numpy as np

from regkit.config.quantities import Coordinate, Length
from regkit.system.arrays import Array
from regkit_synthesis.rooms.part import Part
from regkit_synthesis.rooms.region import SIDES, Region, Side
from regkit_synthesis.rooms.surface import Surface, quad


class Floor(Part):
    """The floor, at the height of the body's lowest point over the whole motion."""

    kind: Literal["floor"] = "floor"

    reach: Length = 4.0
    """How far it goes beyond the region that the body covers, on each side [m]."""

    def surface(self, region: Region, times: Array) -> Surface:
        """Returns the rectangle."""
        (left, front, ground), (right, back, _) = region.lower, region.upper
        left, front, right, back = (
            left - self.reach,
            front - self.reach,
            right + self.reach,
            back + self.reach,
        )
        return quad(
            np.array([
                [left, front, ground],
                [right, front, ground],
                [right, back, ground],
                [left, back, ground],
            ])
        )  # fmt: skip


class Wall(Part):
    """A wall that stands on the ground."""

    kind: Literal["wall"] = "wall"

    side: Side = "back"
    """The side of the body at which it stands, as the camera sees it."""
    distance: Coordinate = 1.0
    """Gap between the region that the body covers and the wall [m]."""
    height: Length = 2.5
    """Height [m]."""
    reach: Length = 4.0
    """How far it goes beyond that region, at both ends [m]."""

    def surface(self, region: Region, times: Array) -> Surface:
        """Returns the rectangle."""
        axis, direction = SIDES[self.side]
        corners = np.empty((4, 3))
        corners[:, axis] = region.face(self.side) + direction * self.distance
        start = region.lower[1 - axis] - self.reach
        end = region.upper[1 - axis] + self.reach
        corners[:, 1 - axis] = [start, end, end, start]
        corners[:, 2] = region.lower[2] + np.array([0.0, 0.0, self.height, self.height])
        return quad(corners)
