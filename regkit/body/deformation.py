"""Deformations of points, lengths and rotations in segments' frames: scale, stretch, mirror."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from regkit.body.vectors import rounded, vector
from regkit.geometry.rotation import vector_to_matrix
from regkit.skeleton.joints import Vector
from regkit.system.arrays import Array

REFLECT = np.array([-1.0, 1.0, 1.0])
"""Factors of a point's reflection in the plane x = 0."""

_TURN = np.array([1.0, -1.0, -1.0])
"""Factors of the reflection of an axis or rotation vector, whose sense of rotation reverses."""


class Deformation(ABC):
    """A map of points, lengths and rotations in a segment's frame."""

    @abstractmethod
    def point(self, point: Vector) -> Vector:
        """Returns the image of a point [m]."""

    @abstractmethod
    def radius(self, radius: float) -> float:
        """Returns the radius of the image of something round, which stays round [m]."""

    @abstractmethod
    def extents(self, extents: Vector, rotation_deg: Vector) -> Vector:
        """Returns the images of lengths [m] along the axes of a rotation vector [deg]."""

    @abstractmethod
    def rotation(self, rotation_deg: Vector) -> Vector:
        """Returns the image of a rotation vector [deg] or of an axis."""


@dataclass(frozen=True)
class Scaling(Deformation):
    """Multiplication of all lengths by a factor."""

    factor: float

    def point(self, point: Vector) -> Vector:
        """Returns the scaled point [m]."""
        x, y, z = point
        return (self.factor * x, self.factor * y, self.factor * z)

    def radius(self, radius: float) -> float:
        """Returns the scaled radius [m]."""
        return self.factor * radius

    def extents(self, extents: Vector, rotation_deg: Vector) -> Vector:
        """Returns the scaled lengths [m]."""
        return self.point(extents)

    def rotation(self, rotation_deg: Vector) -> Vector:
        """Returns the same rotation [deg]."""
        return rotation_deg


@dataclass(frozen=True)
class Stretch(Deformation):
    """A segment's stretch along its bone and across it.

    Attributes:
        matrix: Linear map of positions, (3, 3).
        girth: Factor of radii.
    """

    matrix: Array
    girth: float

    @classmethod
    def along(cls, bone: Array, length: float, girth: float) -> Stretch:
        """Returns a stretch by ``length`` along a bone and ``girth`` across it.

        Args:
            bone: Unit vector of the bone, or zero without a direction, (3,).
            length: Factor along the bone.
            girth: Factor across the bone.
        """
        return cls(girth * np.eye(3) + (length - girth) * np.outer(bone, bone), girth)

    def point(self, point: Vector) -> Vector:
        """Returns the stretched point [m]."""
        return vector(self.matrix @ point)

    def radius(self, radius: float) -> float:
        """Returns the radius multiplied by the girth [m]."""
        return self.girth * radius

    def extents(self, extents: Vector, rotation_deg: Vector) -> Vector:
        """Returns the stretched lengths of the axes, which keep their directions [m]."""
        axes = vector_to_matrix(np.radians(rotation_deg))
        return vector(np.linalg.norm(self.matrix @ axes, axis=0) * extents)

    def rotation(self, rotation_deg: Vector) -> Vector:
        """Returns the same rotation [deg]."""
        return rotation_deg


class Mirror(Deformation):
    """Reflection in the plane x = 0, which exchanges left and right."""

    def point(self, point: Vector) -> Vector:
        """Returns the mirror image of a point [m]."""
        return rounded(REFLECT * point, 15)

    def radius(self, radius: float) -> float:
        """Returns the same radius [m]."""
        return radius

    def extents(self, extents: Vector, rotation_deg: Vector) -> Vector:
        """Returns the same lengths [m]."""
        return extents

    def rotation(self, rotation_deg: Vector) -> Vector:
        """Returns the mirror image of a rotation vector [deg] or of an axis."""
        return rounded(_TURN * rotation_deg, 15)
