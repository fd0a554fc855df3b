"""Rotations as unit quaternions (x, y, z, w), rotation vectors and matrices, all batched.

The scalar comes last, as in the paper (``p = [x, y, z, w]``) and in SciPy. Every function takes any
number of leading dimensions, which SciPy's ``Rotation`` does not, and costs a few microseconds,
which matters here: an energy is evaluated in less time than SciPy needs to build one ``Rotation``.
"""

from __future__ import annotations

import numpy as np

from regkit.arrays import Array

IDENTITY = np.array([0.0, 0.0, 0.0, 1.0])
"""The quaternion of no rotation."""

_SMALL = 1e-4
"""Below this angle [rad] the series below are exact to double precision."""


def skew(vector: Array) -> Array:
    """The matrix [v]x with [v]x u = v x u: (..., 3) -> (..., 3, 3)."""
    x, y, z = vector[..., 0], vector[..., 1], vector[..., 2]
    matrix = np.zeros((*vector.shape, 3))
    matrix[..., 0, 1], matrix[..., 0, 2], matrix[..., 1, 2] = -z, y, -x
    matrix[..., 1, 0], matrix[..., 2, 0], matrix[..., 2, 1] = z, -y, x
    return matrix


def product(left: Array, right: Array) -> Array:
    """The Hamilton product: first ``right`` is applied, then ``left``; (..., 4)."""
    a, b = left[..., :3], right[..., :3]
    s, t = left[..., 3:], right[..., 3:]
    vector = s * b + t * a + np.cross(a, b)
    scalar = s * t - (a * b).sum(axis=-1, keepdims=True)
    return np.concatenate([vector, scalar], axis=-1)


def conjugate(quaternion: Array) -> Array:
    """The inverse of a unit quaternion; (..., 4)."""
    return np.asarray(quaternion * np.array([-1.0, -1.0, -1.0, 1.0]))


def normalized(quaternion: Array) -> Array:
    """``p = r / |r|``, the paper's map from un-normalised quaternions; (..., 4)."""
    return np.asarray(quaternion / np.linalg.norm(quaternion, axis=-1, keepdims=True))


def from_vector(vector: Array) -> Array:
    """Exponential map: rotation vectors (..., 3) [rad] to unit quaternions (..., 4)."""
    square = (vector * vector).sum(axis=-1, keepdims=True)
    half = 0.5 * np.sqrt(square)
    small = half < _SMALL
    scale = np.where(small, 0.5 - square / 48.0, np.sin(half) / np.where(small, 1.0, 2.0 * half))
    return np.concatenate([scale * vector, np.cos(half)], axis=-1)


def to_vector(quaternion: Array) -> Array:
    """Logarithm: unit quaternions (..., 4) to rotation vectors (..., 3) of at most pi [rad]."""
    short = np.where(quaternion[..., 3:] < 0.0, -quaternion, quaternion)
    sine = np.linalg.norm(short[..., :3], axis=-1, keepdims=True)
    small = sine < _SMALL
    angle = 2.0 * np.arctan2(sine, short[..., 3:])
    scale = np.where(small, 2.0 + sine * sine / 3.0, angle / np.where(small, 1.0, sine))
    return np.asarray(scale * short[..., :3])


def to_matrix(quaternion: Array) -> Array:
    """Rotation matrices (..., 3, 3) of unit quaternions (..., 4)."""
    x, y, z, w = (quaternion[..., k] for k in range(4))
    rows = [
        1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
        2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
        2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y),
    ]  # fmt: skip
    return np.stack(rows, axis=-1).reshape(*quaternion.shape[:-1], 3, 3)


def from_matrix(matrix: Array) -> Array:
    """Unit quaternions (..., 4) of rotation matrices (..., 3, 3), with w >= 0.

    Each of the four numbers is read from the largest of the four squares, so that no rotation, half
    a turn included, divides by a small number.
    """
    m = matrix
    xx, yy, zz = m[..., 0, 0], m[..., 1, 1], m[..., 2, 2]
    xy, xz, yz = (
        m[..., 0, 1] + m[..., 1, 0],
        m[..., 0, 2] + m[..., 2, 0],
        m[..., 1, 2] + m[..., 2, 1],
    )
    xw, yw, zw = (
        m[..., 2, 1] - m[..., 1, 2],
        m[..., 0, 2] - m[..., 2, 0],
        m[..., 1, 0] - m[..., 0, 1],
    )
    outer = np.stack([  # 4 q q^T, whose largest row is the best-conditioned multiple of q
        np.stack([1 + xx - yy - zz, xy, xz, xw], axis=-1),
        np.stack([xy, 1 - xx + yy - zz, yz, yw], axis=-1),
        np.stack([xz, yz, 1 - xx - yy + zz, zw], axis=-1),
        np.stack([xw, yw, zw, 1 + xx + yy + zz], axis=-1),
    ], axis=-2)  # fmt: skip
    largest = np.argmax(np.diagonal(outer, axis1=-2, axis2=-1), axis=-1)
    row = np.take_along_axis(outer, largest[..., None, None], axis=-2)[..., 0, :]
    quaternion = normalized(row)
    return np.where(quaternion[..., 3:] < 0.0, -quaternion, quaternion)


def vector_to_matrix(vector: Array) -> Array:
    """Rotation matrices (..., 3, 3) of rotation vectors (..., 3) [rad]."""
    return to_matrix(from_vector(vector))


def between(start: Array, goal: Array) -> Array:
    """The smallest rotation matrix (3, 3) that turns the direction ``start`` (3,) into ``goal``.

    Between opposite directions every axis at right angles to them will do.
    """
    a, b = start / np.linalg.norm(start), goal / np.linalg.norm(goal)
    axis = np.cross(a, b)
    sine = float(np.linalg.norm(axis))
    if sine < 1e-9:
        axis = np.cross(a, np.eye(3)[np.argmin(np.abs(a))])
    angle = np.arctan2(sine, float(a @ b))
    return vector_to_matrix(angle * axis / np.linalg.norm(axis))


def right_jacobian(vector: Array) -> Array:
    """J with exp(v + dv) = exp(v) exp(J dv) to first order: (..., 3) -> (..., 3, 3).

    Source: Chirikjian, Stochastic Models, Information Theory, and Lie Groups, vol. 2, eq. 10.86.
    """
    square = (vector * vector).sum(axis=-1)[..., None, None]
    angle = np.sqrt(square)
    small = angle < _SMALL
    safe = np.where(small, 1.0, angle)
    first = np.where(small, 0.5 - square / 24.0, (1.0 - np.cos(angle)) / safe**2)
    second = np.where(small, 1.0 / 6.0 - square / 120.0, (angle - np.sin(angle)) / safe**3)
    cross = skew(vector)
    return np.asarray(np.eye(3) - first * cross + second * (cross @ cross))


def swing_twist(quaternion: Array, axis: Array) -> tuple[Array, Array]:
    """Split q = swing * twist into the swing vector and the twist angle about ``axis``.

    The swing (..., 3) [rad] is at right angles to the axis, a unit vector; the twist (...) [rad] is
    in (-pi, pi].
    Where the swing is half a turn the twist is not defined, and zero is returned for it.
    """
    along = (quaternion[..., :3] * axis).sum(axis=-1)
    scalar = quaternion[..., 3]
    length = np.hypot(along, scalar)
    undefined = length < 1e-12
    cosine = np.where(undefined, 1.0, scalar / np.where(undefined, 1.0, length))
    sine = np.where(undefined, 0.0, along / np.where(undefined, 1.0, length))
    twist = np.concatenate([sine[..., None] * axis, cosine[..., None]], axis=-1)
    swing = to_vector(product(quaternion, conjugate(twist)))
    angle = 2.0 * np.arctan2(sine, cosine)
    return swing, np.where(
        angle > np.pi, angle - 2 * np.pi, np.where(angle <= -np.pi, angle + 2 * np.pi, angle)
    )
