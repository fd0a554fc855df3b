"""Checks that two clouds can be aligned at all, made before any computation."""

from __future__ import annotations

import numpy as np

from regkit.clouds.bounds import POINTS, bounds
from regkit.clouds.compiled_moments import moments
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.threads import in_chunks

MIN_POINTS = 10
"""Minimum number of distinct points, more than enough for six degrees of freedom."""

FIRST = 1000
"""Number of points that usually contain so many distinct ones."""

MIN_EXTENT = 1e-3
"""A cloud whose extent in a principal direction is below this fraction of the largest is flat."""

MAX_SIZE_RATIO = 20.0
"""Clouds whose sizes differ by a larger factor do not show the same object in the same unit."""


def check_shape(points: Array, *, place: str) -> None:
    """Rejects a cloud whose alignment would be underdetermined.

    Args:
        points: The cloud, (N, 3) [m].
        place: Where it comes from, for the error message.

    Raises:
        DataError: If it has too few distinct points, or is collinear or coplanar.
    """
    distinct = len(np.unique(points[:FIRST], axis=0))
    if distinct < MIN_POINTS:
        distinct = len(np.unique(points, axis=0))
    if distinct < MIN_POINTS:
        raise DataError(
            f"the cloud has {distinct} different points of {len(points)}; at least {MIN_POINTS} "
            "are needed",
            place=place,
        )
    # The eigenvalues of the scatter matrix are exact enough, and take a hundredth of the time of
    # the singular values of the cloud, whose squares they are.
    squares = np.linalg.eigvalsh(_scatter(points))[::-1]
    lengths = np.sqrt(np.maximum(squares, 0.0))
    if lengths[1] < MIN_EXTENT * lengths[0]:
        raise DataError(
            "all points lie on a line, so the rotation about it is undetermined; the cloud must "
            "extend in three dimensions",
            place=place,
        )
    if lengths[2] < MIN_EXTENT * lengths[0]:
        raise DataError(
            "all points lie in a plane, so motions within it are undetermined; the cloud must "
            "extend in three dimensions",
            place=place,
        )


def _scatter(points: Array) -> Array:
    """Returns the scatter matrix (3, 3) [m^2] of points (N, 3) [m]."""
    points = np.ascontiguousarray(points, dtype=float)

    def part(begin: int, end: int) -> Array:
        return moments(points[begin:end], points[0])

    sums = np.sum(in_chunks(part, len(points), POINTS), axis=0)
    # The first point is within the cloud, so that coordinates relative to it are small.
    return np.asarray(sums[1:, 1:] - np.outer(sums[0, 1:], sums[0, 1:]) / sums[0, 0])


def check_sizes(source: Array, target: Array) -> None:
    """Rejects clouds whose sizes suggest different units.

    Args:
        source: Source points, (N, 3).
        target: Target points, (M, 3).

    Raises:
        DataError: If their sizes differ by more than ``MAX_SIZE_RATIO``.
    """
    boxes = bounds(source), bounds(target)
    sizes = [float(np.linalg.norm(high - low)) for low, high in boxes]
    factor = max(sizes) / min(sizes)
    if factor <= MAX_SIZE_RATIO:
        return
    hint = " (one in millimetres, the other in metres?)" if 200.0 < factor < 5000.0 else ""
    raise DataError(
        f"the source is {sizes[0]:.4g} large and the target {sizes[1]:.4g}, a factor of "
        f"{factor:.3g}; convert both to the same unit{hint}, or crop the larger one"
    )
