"""Rotations as unit quaternions (x, y, z, w), rotation vectors and matrices, all batched.

The scalar component is last, as in the paper (``p = [x, y, z, w]``) and in SciPy. Unlike SciPy's
``Rotation``, every function accepts any number of leading dimensions and takes only a few
microseconds: an energy is evaluated in less time than SciPy needs to construct one ``Rotation``.
"""

from __future__ import annotations

import numpy as np

from regkit.geometry.bilinear import hamilton, matrix_of_products, products_of_matrix
from regkit.system.arrays import Array

IDENTITY = np.array([0.0, 0.0, 0.0, 1.0])
"""The identity quaternion."""

_SMALL = 1e-4
"""Below this angle [rad] the truncated series are exact to double precision."""


def skew(vector: Array) -> Array:
    """Returns the skew-symmetric matrix [v]x with [v]x u = v x u: (..., 3) -> (..., 3, 3)."""
    x, y, z = vector[..., 0], vector[..., 1], vector[..., 2]
    matrix = np.zeros((*vector.shape, 3))
    matrix[..., 0, 1], matrix[..., 0, 2], matrix[..., 1, 2] = -z, y, -x
    matrix[..., 1, 0], matrix[..., 2, 0], matrix[..., 2, 1] = z, -y, x
    return matrix


def axial(matrix: Array) -> Array:
    """Returns (M_yz - M_zy, M_zx - M_xz, M_xy - M_yx): (..., 3, 3) -> (..., 3)."""
    return np.asarray(matrix.reshape(*matrix.shape[:-2], 9) @ _AXIAL)


def cross(a: Array, b: Array) -> Array:
    """Returns the cross product of (..., 3) and (..., 3).

    For few vectors it is about ten times as fast as ``numpy.cross``.
    """
    forward = a.take(_NEXT, -1) * b.take(_AFTER, -1)
    return np.asarray(forward - a.take(_AFTER, -1) * b.take(_NEXT, -1))


_NEXT, _AFTER = np.array([1, 2, 0]), np.array([2, 0, 1])
"""Cyclic successors of the axes x, y, z, by one and by two."""


_HAMILTON = hamilton()
_MATRIX_OF_PRODUCTS, _PRODUCTS_OF_MATRIX = matrix_of_products(), products_of_matrix()

_AXIAL = -skew(np.eye(3)).reshape(3, 9).T
"""The table from a flattened matrix to its axial vector, (9, 3)."""


def product(left: Array, right: Array) -> Array:
    """Returns the Hamilton product (..., 4), the rotation by ``right`` followed by ``left``."""
    outer = left[..., :, None] * right[..., None, :]
    return np.asarray(outer.reshape(*outer.shape[:-2], 16) @ _HAMILTON)


def conjugate(quaternion: Array) -> Array:
    """Returns the inverse (..., 4) of unit quaternions (..., 4)."""
    return np.asarray(quaternion * np.array([-1.0, -1.0, -1.0, 1.0]))


def normalized(quaternion: Array) -> Array:
    """Returns ``p = r / |r|`` (..., 4), the paper's map from unnormalised quaternions (..., 4)."""
    return np.asarray(quaternion / np.linalg.norm(quaternion, axis=-1, keepdims=True))


def from_vector(vector: Array) -> Array:
    """Exponential map: returns unit quaternions (..., 4) of rotation vectors (..., 3) [rad]."""
    square = (vector * vector).sum(axis=-1, keepdims=True)
    half = 0.5 * np.sqrt(square)
    small = half < _SMALL
    scale = np.where(small, 0.5 - square / 48.0, np.sin(half) / np.where(small, 1.0, 2.0 * half))
    return np.concatenate([scale * vector, np.cos(half)], axis=-1)


def to_vector(quaternion: Array) -> Array:
    """Logarithm: returns rotation vectors (..., 3) [rad], at most pi long, of unit quaternions."""
    short = np.where(quaternion[..., 3:] < 0.0, -quaternion, quaternion)
    sine = np.linalg.norm(short[..., :3], axis=-1, keepdims=True)
    small = sine < _SMALL
    angle = 2.0 * np.arctan2(sine, short[..., 3:])
    scale = np.where(small, 2.0 + sine * sine / 3.0, angle / np.where(small, 1.0, sine))
    return np.asarray(scale * short[..., :3])


def to_matrix(quaternion: Array) -> Array:
    """Returns rotation matrices (..., 3, 3) of unit quaternions (..., 4)."""
    # Each entry is linear in the products of two quaternion components.
    outer = quaternion[..., :, None] * quaternion[..., None, :]
    matrix = outer.reshape(*quaternion.shape[:-1], 16) @ _MATRIX_OF_PRODUCTS
    return np.asarray(matrix.reshape(*quaternion.shape[:-1], 3, 3))


def from_matrix(matrix: Array) -> Array:
    """Returns unit quaternions (..., 4) with w >= 0 of rotation matrices (..., 3, 3).

    The component with the largest square is the pivot, so no rotation divides by a small number,
    not even one by pi.
    """
    shape = matrix.shape[:-2]
    # The row of 4 q q^T with the largest diagonal entry is the best-conditioned multiple of q.
    outer = matrix.reshape(*shape, 9) @ _PRODUCTS_OF_MATRIX + np.eye(4).ravel()
    largest = outer[..., ::5].argmax(axis=-1)
    rows = outer.reshape(*shape, 4, 4)
    row = np.take_along_axis(rows, largest[..., None, None], axis=-2)[..., 0, :]
    quaternion = normalized(row)
    return np.where(quaternion[..., 3:] < 0.0, -quaternion, quaternion)


def vector_to_matrix(vector: Array) -> Array:
    """Returns rotation matrices (..., 3, 3) of rotation vectors (..., 3) [rad]."""
    return to_matrix(from_vector(vector))


def rotation_between(start: Array, goal: Array) -> Array:
    """Returns the smallest rotation (3, 3) from the direction ``start`` (3,) to ``goal`` (3,).

    For opposite directions the rotation axis is an arbitrary perpendicular one.
    """
    a, b = start / np.linalg.norm(start), goal / np.linalg.norm(goal)
    axis = cross(a, b)
    sine = float(np.linalg.norm(axis))
    if sine < 1e-9:
        axis = np.cross(a, np.eye(3)[np.argmin(np.abs(a))])
    angle = np.arctan2(sine, float(a @ b))
    return vector_to_matrix(angle * axis / np.linalg.norm(axis))


def right_jacobian(vector: Array) -> Array:
    """Returns J with exp(v + dv) = exp(v) exp(J dv) to first order: (..., 3) -> (..., 3, 3).

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
    """Decomposes q = swing * twist into the swing vector and the twist angle about ``axis``.

    Args:
        quaternion: Unit quaternions, (..., 4).
        axis: Unit vectors, (3,) or (..., 3).

    Returns:
        The swing, a rotation vector (..., 3) [rad] perpendicular to the axis, and the twist (...)
        [rad] in (-pi, pi]. If the swing angle is pi, the twist is undefined and returned as zero.
    """
    along = (quaternion[..., :3] * axis).sum(axis=-1)
    scalar = quaternion[..., 3]
    undefined = np.hypot(along, scalar) < 1e-12
    half = np.where(undefined, 0.0, np.arctan2(along, scalar))
    untwist = np.concatenate([-np.sin(half)[..., None] * axis, np.cos(half)[..., None]], axis=-1)
    swing = to_vector(product(quaternion, untwist))
    # Half the twist is in (-pi, pi]; the full twist is wrapped to the same interval.
    twist = 2.0 * half
    return swing, twist - 2.0 * np.pi * np.ceil(0.5 * twist / np.pi - 0.5)
