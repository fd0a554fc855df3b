"""Principal axes of points."""

from __future__ import annotations

from itertools import permutations, product

import numpy as np

from regkit.system.arrays import Array

_PERMUTATIONS = np.array(
    [
        np.diag(signs)[:, order]
        for order in permutations(range(3))
        for signs in product((1.0, -1.0), repeat=3)
        if np.linalg.det(np.diag(signs)[:, order]) > 0.0
    ]
)
"""The 24 rotations (24, 3, 3) that permute and flip coordinate axes."""


def principal_axes(points: Array) -> tuple[Array, Array]:
    """Returns the principal axes of points, and the standard deviations along them.

    The axes are ordered and signed so that their rotation from the coordinate axes is smallest.

    Args:
        points: The points, (N, 3) [m].

    Returns:
        A rotation matrix with the axes as columns, (3, 3), and standard deviations (3,) [m].
    """
    variances, vectors = np.linalg.eigh(np.cov(points.T, bias=True))
    if np.linalg.det(vectors) < 0.0:
        vectors = -vectors
    rotations = vectors @ _PERMUTATIONS
    best = int(np.trace(rotations, axis1=1, axis2=2).argmax())
    return rotations[best], np.sqrt(variances @ np.abs(_PERMUTATIONS[best]))
