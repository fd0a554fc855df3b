"""Rotations as CasADi expressions with smooth derivatives, also at the identity."""

from __future__ import annotations

from typing import Any

from regkit.system.optional import load_library

SMALL = 1e-4
"""Below this squared angle, or squared sine, series replace quotients."""


def product(left: Any, right: Any) -> Any:
    """Returns the Hamilton product of quaternions (x, y, z, w), ``right`` followed by ``left``."""
    ca = load_library("casadi")
    vector = left[3] * right[:3] + right[3] * left[:3] + ca.cross(left[:3], right[:3])
    return ca.vertcat(vector, left[3] * right[3] - ca.dot(left[:3], right[:3]))


def exponential(vector: Any) -> Any:
    """Returns the unit quaternion (4,) of a rotation vector (3,) [rad]."""
    ca = load_library("casadi")
    square = ca.dot(vector, vector)
    small = square < SMALL
    half = 0.5 * ca.sqrt(ca.if_else(small, 1.0, square))
    quarter = square / 4.0
    series = 0.5 * (1.0 - quarter / 6.0 * (1.0 - quarter / 20.0 * (1.0 - quarter / 42.0)))
    sine = ca.if_else(small, series, ca.sin(half) / (2.0 * half))
    level = 1.0 - quarter / 2.0 * (1.0 - quarter / 12.0 * (1.0 - quarter / 30.0))
    return ca.vertcat(sine * vector, ca.if_else(small, level, ca.cos(half)))


def matrix(quaternion: Any) -> Any:
    """Returns the rotation matrix (3, 3) of a unit quaternion (4,)."""
    ca = load_library("casadi")
    cross = ca.skew(quaternion[:3])
    return ca.DM.eye(3) + 2.0 * quaternion[3] * cross + 2.0 * cross @ cross


def normalized(quaternion: Any) -> Any:
    """Returns the normalised quaternion ``p = r / |r|``, (4,)."""
    return quaternion / load_library("casadi").norm_2(quaternion)
