"""Rigid motions as 4x4 matrices; ``T_a_b`` maps b-coordinates to a. All functions are batched."""

from __future__ import annotations

import numpy as np

from regkit.geometry.rotation import from_matrix, right_jacobian, to_vector, vector_to_matrix
from regkit.system.arrays import Array


def rigid(rotation: Array, translation: Array) -> Array:
    """The (..., 4, 4) matrix of a rotation (..., 3, 3) and a translation (..., 3) [m]."""
    batch = np.broadcast_shapes(rotation.shape[:-2], translation.shape[:-1])
    transform = np.zeros((*batch, 4, 4))
    transform[..., :3, :3] = rotation
    transform[..., :3, 3] = translation
    transform[..., 3, 3] = 1.0
    return transform


def inverse(transform: Array) -> Array:
    """The inverse motion T_b_a of T_a_b; (..., 4, 4)."""
    transposed = np.swapaxes(transform[..., :3, :3], -1, -2)
    return rigid(transposed, -(transposed @ transform[..., :3, 3:])[..., 0])


def transformed(transform: Array, points: Array) -> Array:
    """Points (N, 3) of frame b in frame a, by one T_a_b (4, 4) or one for each (N, 4, 4)."""
    if transform.ndim == 2:
        return np.asarray(points @ transform[:3, :3].T + transform[:3, 3])
    return np.asarray((transform[:, :3, :3] @ points[:, :, None])[:, :, 0] + transform[:, :3, 3])


def exp(twist: Array) -> Array:
    """The motion (..., 4, 4) in unit time of a twist (..., 6): linear [m], then angular [rad].

    Source: Murray, Li, Sastry, A Mathematical Introduction to Robotic Manipulation, eq. 2.36.
    """
    linear, angular = twist[..., :3], twist[..., 3:]
    left_jacobian = right_jacobian(-angular)
    return rigid(vector_to_matrix(angular), (left_jacobian @ linear[..., None])[..., 0])


def log(transform: Array) -> Array:
    """The twist (..., 6), linear first, with ``exp(twist) = transform``; at most half a turn."""
    angular = to_vector(from_matrix(transform[..., :3, :3]))
    left_jacobian = right_jacobian(-angular)
    linear = np.linalg.solve(left_jacobian, transform[..., :3, 3:])[..., 0]
    return np.concatenate([linear, angular], axis=-1)
