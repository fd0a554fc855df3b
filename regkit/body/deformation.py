"""Deformations: how everything in a segment's frame changes when a body is made another."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from regkit.body.vectors import rounded, vector
from regkit.geometry.rotation import vector_to_matrix
from regkit.skeleton.joints import Vector
from regkit.system.arrays import Array

REFLECT = np.array([-1.0, 1.0, 1.0])
"""What a point is multiplied by to be reflected in the plane x = 0."""

_TURN = np.array([1.0, -1.0, -1.0])
"""What an axis or a rotation vector is multiplied by: its sense of rotation is reflected, too."""


class Deformation(ABC):
    """What happens to points, lengths and rotations in a segment's frame."""

    @abstractmethod
    def point(self, point: Vector) -> Vector:
        """Returns a point [m]."""

    @abstractmethod
    def radius(self, radius: float) -> float:
        """Returns the radius of something round [m]; it stays round."""

    @abstractmethod
    def extents(self, extents: Vector, rotation_deg: Vector) -> Vector:
        """Lengths [m] along the axes of a rotation vector [deg]."""

    @abstractmethod
    def rotation(self, rotation_deg: Vector) -> Vector:
        """Returns a rotation vector, or an axis."""


@dataclass(frozen=True)
class Scaling(Deformation):
    """All lengths are multiplied by a factor."""

    factor: float

    def point(self, point: Vector) -> Vector:
        """Returns the point, farther from the segment's joint."""
        x, y, z = point
        return (self.factor * x, self.factor * y, self.factor * z)

    def radius(self, radius: float) -> float:
        """Returns the radius, multiplied."""
        return self.factor * radius

    def extents(self, extents: Vector, rotation_deg: Vector) -> Vector:
        """Returns the lengths, multiplied."""
        return self.point(extents)

    def rotation(self, rotation_deg: Vector) -> Vector:
        """Returns the same rotation."""
        return rotation_deg


@dataclass(frozen=True)
class Stretch(Deformation):
    """A segment becomes longer along its bone and thicker across it.

    Attributes:
        matrix: What positions are multiplied by, (3, 3).
        girth: What radii are multiplied by.
    """

    matrix: Array
    girth: float

    @classmethod
    def along(cls, bone: Array, length: float, girth: float) -> Stretch:
        """A factor along the unit vector of a bone (3,), zero for none, and one across it."""
        return cls(girth * np.eye(3) + (length - girth) * np.outer(bone, bone), girth)

    def point(self, point: Vector) -> Vector:
        """Returns the point, moved along and across the bone."""
        return vector(self.matrix @ point)

    def radius(self, radius: float) -> float:
        """Returns the radius, by the girth."""
        return self.girth * radius

    def extents(self, extents: Vector, rotation_deg: Vector) -> Vector:
        """Returns the lengths that their axes get, which keep their directions."""
        axes = vector_to_matrix(np.radians(rotation_deg))
        return vector(np.linalg.norm(self.matrix @ axes, axis=0) * extents)

    def rotation(self, rotation_deg: Vector) -> Vector:
        """Returns the same rotation."""
        return rotation_deg


class Mirror(Deformation):
    """The reflection in the plane x = 0: right from left."""

    def point(self, point: Vector) -> Vector:
        """Returns the mirror image of a point."""
        return rounded(REFLECT * point, 15)

    def radius(self, radius: float) -> float:
        """Returns the same radius."""
        return radius

    def extents(self, extents: Vector, rotation_deg: Vector) -> Vector:
        """Returns the same lengths."""
        return extents

    def rotation(self, rotation_deg: Vector) -> Vector:
        """Returns the mirror image of a rotation vector, or of an axis."""
        return rounded(_TURN * rotation_deg, 15)
