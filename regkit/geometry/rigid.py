"""Rigid motions as 4x4 matrices; ``T_a_b`` maps coordinates of frame b to frame a.

All functions accept any number of leading dimensions.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from regkit.geometry.rotation import from_matrix, right_jacobian, to_vector, vector_to_matrix
from regkit.system.arrays import MAX_COORDINATE, Array
from regkit.system.errors import DataError
from regkit.system.notes import note

ORTHOGONALITY = 1e-3
"""Largest relative error of lengths under a matrix that still counts as a rotation."""

ROUNDING = 1e-5
"""Largest error of a rotation's numbers that is corrected without a word."""


def rigid(rotation: Array, translation: Array) -> Array:
    """Returns the matrix (..., 4, 4) of a rotation (..., 3, 3) and a translation (..., 3) [m]."""
    batch = np.broadcast_shapes(rotation.shape[:-2], translation.shape[:-1])
    transform = np.zeros((*batch, 4, 4))
    transform[..., :3, :3] = rotation
    transform[..., :3, 3] = translation
    transform[..., 3, 3] = 1.0
    return transform


def checked_rigid(values: ArrayLike, *, place: str | None = None) -> Array:
    """Returns a rigid motion (4, 4) from a user or a file, with an exactly orthogonal rotation.

    Args:
        values: The matrix, (4, 4), by rows.
        place: Where it comes from, for messages.

    Raises:
        DataError: If its last row is not 0 0 0 1, or it scales, shears or reflects.
    """
    try:
        matrix = np.array(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise DataError("a rigid motion must be a matrix of 4x4 numbers", place=place) from None
    if matrix.shape != (4, 4) or not np.isfinite(matrix).all():
        raise DataError(
            f"a rigid motion must be 4x4 finite numbers; the shape is {matrix.shape}", place=place
        )
    largest = float(np.abs(matrix).max())
    if largest > MAX_COORDINATE:
        raise DataError(
            f"the matrix is not a rigid motion: it holds {largest:g}, beyond any length",
            place=place,
        )
    last = [0.0, 0.0, 0.0, 1.0]
    if not np.array_equal(matrix[3], last):
        hint = "; it is written by columns: transpose it" if list(matrix[:, 3]) == last else ""
        raise DataError(
            f"the matrix is not a rigid motion: its last row is {matrix[3].tolist()}, not 0 0 0 1"
            + hint,
            place=place,
        )
    rotation = matrix[:3, :3]
    reason = _not_a_rotation(rotation)
    if reason is not None:
        raise DataError(f"the matrix is not a rigid motion: it {reason}", place=place)
    left, _, right = np.linalg.svd(rotation)
    change = float(np.abs(left @ right - rotation).max())
    if change > ROUNDING:
        note(
            f"the rotation is orthogonal to {change:.1g} only; the nearest rotation is taken",
            place=place,
        )
    matrix[:3, :3] = left @ right
    return matrix


def _not_a_rotation(matrix: Array) -> str | None:
    """Returns what a matrix (3, 3) does that a rotation does not, or None."""
    left, scales, right = np.linalg.svd(matrix)
    if scales[2] <= 1e-9 * scales[0]:
        return "flattens space (its determinant is zero)"
    even = scales[0] - scales[2] < ORTHOGONALITY * scales[0]
    if even and abs(scales.mean() - 1.0) > ORTHOGONALITY:
        return f"scales by {scales.mean():.6g}; remove the scale"
    if not even:
        lengths = ", ".join(f"{length:.4g}" for length in scales)
        return f"stretches or shears by {lengths}; its columns must be orthogonal unit vectors"
    if np.linalg.det(left @ right) < 0.0:
        return "reflects (its determinant is -1); an axis or a column has the wrong sign"
    return None


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
