"""Rotation functions on scalars for compiled loops; see ``regkit.geometry.rotation``."""

from __future__ import annotations

from math import cos, sin, sqrt

from regkit.system.arrays import Array
from regkit.system.compiled import compiled


@compiled
def set_rotation(matrix: Array, x: float, y: float, z: float, w: float) -> None:
    """Writes the rotation matrix of a unit quaternion into ``matrix`` (3, 3)."""
    matrix[0, 0] = 1 - 2 * (y * y + z * z)
    matrix[1, 1] = 1 - 2 * (x * x + z * z)
    matrix[2, 2] = 1 - 2 * (x * x + y * y)
    matrix[0, 1], matrix[1, 0] = 2 * (x * y - z * w), 2 * (x * y + z * w)
    matrix[2, 0], matrix[0, 2] = 2 * (x * z - y * w), 2 * (x * z + y * w)
    matrix[1, 2], matrix[2, 1] = 2 * (y * z - x * w), 2 * (y * z + x * w)


@compiled
def exponential(x: float, y: float, z: float) -> tuple[float, float, float, float]:
    """Returns the unit quaternion (x, y, z, w) of a rotation vector (x, y, z) [rad]."""
    square = x * x + y * y + z * z
    half = 0.5 * sqrt(square)
    scale = 0.5 - square / 48.0 if half < 1e-4 else sin(half) / (2.0 * half)
    return scale * x, scale * y, scale * z, cos(half)


@compiled
def hamilton_product(
    a: float, b: float, c: float, d: float, x: float, y: float, z: float, w: float
) -> tuple[float, float, float, float]:
    """Returns the Hamilton product of the quaternions (a, b, c, d) and (x, y, z, w)."""
    return (
        d * x + w * a + b * z - c * y,
        d * y + w * b + c * x - a * z,
        d * z + w * c + a * y - b * x,
        d * w - a * x - b * y - c * z,
    )
