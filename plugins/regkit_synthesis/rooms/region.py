"""The region that a body covers over time, beside which the parts of a room are placed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from regkit.system.arrays import Array

Side = Literal["back", "front", "left", "right"]

SIDES: Mapping[Side, tuple[int, int]] = {
    "back": (1, 1),
    "front": (1, -1),
    "left": (0, -1),
    "right": (0, 1),
}
"""Axis and direction of each side as the camera sees it."""


@dataclass(frozen=True)
class Region:
    """A box in room axes: x to the right of the image, y away from the camera, z up.

    Attributes:
        lower: The least coordinates, (3,) [m]; the ground has the height ``lower[2]``.
        upper: The largest coordinates, (3,) [m].
    """

    lower: Array
    upper: Array

    @classmethod
    def around(cls, clouds: Iterable[Array]) -> Region:
        """Returns the bounds of all points (N, 3) [m] of one or more clouds."""
        ends = np.array([(cloud.min(axis=0), cloud.max(axis=0)) for cloud in clouds])
        return cls(ends[:, 0].min(axis=0), ends[:, 1].max(axis=0))

    @property
    def middle(self) -> Array:
        """Returns the middle, (3,) [m]."""
        return (self.lower + self.upper) / 2.0

    def face(self, side: Side) -> float:
        """Returns the coordinate of a side on its axis [m]."""
        axis, direction = SIDES[side]
        return float((self.upper if direction > 0 else self.lower)[axis])

    def offset_beside(self, other: Region, side: Side, distance: float, shift: float) -> Array:
        """Returns the translation (3,) [m] that puts this region on the ground beside another.

        Args:
            other: The other region.
            side: The side of the other region.
            distance: Gap between both regions [m]; negative if they overlap.
            shift: Displacement of the middle along that side [m]: to the right of the image, or
                away from the camera.
        """
        axis, direction = SIDES[side]
        offset = other.middle - self.middle
        offset[1 - axis] += shift
        nearest = self.lower if direction > 0 else self.upper
        offset[axis] = other.face(side) + direction * distance - nearest[axis]
        offset[2] = other.lower[2] - self.lower[2]
        return np.asarray(offset)
