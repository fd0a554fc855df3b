"""Furniture made of boxes."""

from __future__ import annotations

from abc import ABC, abstractmethod
from math import radians
from typing import Literal

import numpy as np

from regkit.config.quantities import Coordinate, Length, Margin
from regkit.geometry.rotation import vector_to_matrix
from regkit.system.arrays import Array
from regkit_synthesis.boxes import boxes
from regkit_synthesis.rooms.part import Standing
from regkit_synthesis.rooms.region import Region
from regkit_synthesis.rooms.surface import Surface

_LEG = 0.05
"""Thickness of a leg [m]."""

_BOARD = 0.04
"""Thickness of a board [m]."""


class Furniture(Standing, ABC):
    """A piece of furniture, which may be pushed along the ground."""

    velocity: tuple[Coordinate, Coordinate] = (0.0, 0.0)
    """Velocity to the right of the image and away from the camera [m/s]; its place is that of the
    first frame."""

    @abstractmethod
    def boxes(self) -> Array:
        """Returns its boxes (B, 2, 3) [m]: least and largest coordinates, facing -y."""

    def surface(self, region: Region, times: Array) -> Surface:
        """Returns the surface of the boxes at their place."""
        turn = vector_to_matrix(np.array([0.0, 0.0, radians(self.heading_deg)]))
        vertices, faces = boxes(self.boxes())
        vertices = vertices @ turn.T
        own = Region.around([vertices * [1.0, 1.0, 0.0]])  # Its foot, above which it may float.
        vertices += own.offset_beside(region, self.side, self.distance, self.shift)
        way = np.array([*self.velocity, 0.0])
        return Surface(faces, lambda time: vertices + time * way, still=not way.any())


class Box(Furniture):
    """A box, such as a cupboard, a desk with a closed front, or a pet."""

    kind: Literal["box"] = "box"

    size: tuple[Length, Length, Length]
    """Width, depth and height [m]."""
    above: Margin = 0.0
    """Height of its underside above the ground [m]."""

    def boxes(self) -> Array:
        """Returns the box."""
        width, depth, height = self.size
        return _boxes((0.0, 0.0, width, depth, self.above, self.above + height))


class Table(Furniture):
    """A table with four legs."""

    kind: Literal["table"] = "table"

    size: tuple[Length, Length, Length] = (1.2, 0.7, 0.74)
    """Width, depth and height [m]."""

    def boxes(self) -> Array:
        """Returns the top and the legs."""
        width, depth, height = self.size
        top = (0.0, 0.0, width, depth, height - _BOARD, height)
        return _boxes(top, *_legs(width, depth, height - _BOARD))


class Chair(Furniture):
    """A chair with four legs and a back."""

    kind: Literal["chair"] = "chair"

    size: tuple[Length, Length, Length] = (0.45, 0.45, 0.9)
    """Width, depth and height of the back [m]."""
    seat: Length = 0.46
    """Height of the seat [m]."""

    def boxes(self) -> Array:
        """Returns the seat, the legs and the back."""
        width, depth, height = self.size
        seat = (0.0, 0.0, width, depth, self.seat - _BOARD, self.seat)
        back = (0.0, (depth - _BOARD) / 2.0, width, _BOARD, self.seat, height)
        return _boxes(seat, back, *_legs(width, depth, self.seat - _BOARD))


_Spans = tuple[float, float, float, float, float, float]
"""Middle x and y, width and depth, lower and upper height of a box [m]."""


def _legs(width: float, depth: float, height: float) -> list[_Spans]:
    """Returns four legs at the corners of a board."""
    x, y = (width - _LEG) / 2.0, (depth - _LEG) / 2.0
    return [(a * x, b * y, _LEG, _LEG, 0.0, height) for a in (-1, 1) for b in (-1, 1)]


def _boxes(*spans: _Spans) -> Array:
    """Returns boxes (B, 2, 3) [m] by their least and largest coordinates."""
    x, y, width, depth, lower, upper = np.array(spans).T
    least = np.column_stack([x - width / 2.0, y - depth / 2.0, lower])
    largest = np.column_stack([x + width / 2.0, y + depth / 2.0, upper])
    return np.stack([least, largest], axis=1)
