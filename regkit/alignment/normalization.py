"""Coordinates in which a cloud has about unit size."""

from __future__ import annotations

from dataclasses import dataclass

from regkit.geometry.rigid import rigid
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Normalization:
    """Coordinates in which a cloud has about unit size, as the thresholds of libraries assume.

    Attributes:
        origin: Origin of the normalised coordinates, (3,) [m].
        unit: Unit of the normalised coordinates [m].
    """

    origin: Array
    unit: float

    @classmethod
    def around(cls, points: Array, unit: float) -> Normalization:
        """Returns coordinates with the origin at the centroid of points (N, 3) [m]."""
        return cls(points.mean(axis=0), unit)

    def normalized(self, points: Array) -> Array:
        """Returns points (N, 3) [m] in normalised coordinates."""
        return (points - self.origin) / self.unit

    def transform(self, rotation: Array, translation: Array) -> Array:
        """Returns the motion (4, 4) [m] of a motion in normalised coordinates.

        Args:
            rotation: Rotation matrix, (3, 3).
            translation: Translation in normalised coordinates, (3,).
        """
        shift = self.unit * translation + self.origin - rotation @ self.origin
        return rigid(rotation, shift)
