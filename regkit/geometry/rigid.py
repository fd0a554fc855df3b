"""Rigid motions as 4x4 matrices; ``T_a_b`` maps coordinates of frame b to frame a.

All functions accept any number of leading dimensions.
"""

from __future__ import annotations

import numpy as np

from regkit.geometry.rotation import from_matrix, right_jacobian, to_vector, vector_to_matrix
from regkit.system.arrays import Array


def rigid(rotation: Array, translation: Array) -> Array:
    """Returns the matrix (..., 4, 4) of a rotation (..., 3, 3) and a translation (..., 3) [m]."""
    batch = np.broadcast_shapes(rotation.shape[:-2], translation.shape[:-1])
    transform = np.zeros((*batch, 4, 4))
    transform[..., :3, :3] = rotation
    transform[..., :3, 3] = translation
    transform[..., 3, 3] = 1.0
    return transform


def inverse(transform: Array) -> Array:
    """Returns T_b_a (..., 4, 4), the inverse of T_a_b (..., 4, 4)."""
    transposed = np.swapaxes(transform[..., :3, :3], -1, -2)
    return rigid(transposed, -(transposed @ transform[..., :3, 3:])[..., 0])


def transformed(transform: Array, points: Array) -> Array:
    """Returns points (N, 3) [m] of frame b in frame a.

    Args:
        transform: T_a_b, one for all points (4, 4) or one per point (N, 4, 4).
        points: Points in frame b, (N, 3) [m].
    """
    if transform.ndim == 2:
        return np.asarray(points @ transform[:3, :3].T + transform[:3, 3])
    return np.asarray((transform[:, :3, :3] @ points[:, :, None])[:, :, 0] + transform[:, :3, 3])


def exp(twist: Array) -> Array:
    """Exponential map: returns the motion (..., 4, 4) of a twist (..., 6), linear [m] first.

    Source: Murray, Li, Sastry, A Mathematical Introduction to Robotic Manipulation, eq. 2.36.
    """
    linear, angular = twist[..., :3], twist[..., 3:]
    left_jacobian = right_jacobian(-angular)
    return rigid(vector_to_matrix(angular), (left_jacobian @ linear[..., None])[..., 0])


def log(transform: Array) -> Array:
    """Logarithm: returns the twist (..., 6), linear first, with ``exp(twist) = transform``.

    The rotation angle is at most pi.
    """
    angular = to_vector(from_matrix(transform[..., :3, :3]))
    left_jacobian = right_jacobian(-angular)
    linear = np.linalg.solve(left_jacobian, transform[..., :3, 3:])[..., 0]
    return np.concatenate([linear, angular], axis=-1)
