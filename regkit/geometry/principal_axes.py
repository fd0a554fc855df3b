"""The principal axes of points."""

from __future__ import annotations

from itertools import permutations, product

import numpy as np

from regkit.system.arrays import Array

_TURNS = np.array(
    [
        np.diag(signs)[:, order]
        for order in permutations(range(3))
        for signs in product((1.0, -1.0), repeat=3)
        if np.linalg.det(np.diag(signs)[:, order]) > 0.0
    ]
)
"""The 24 ways (24, 3, 3) to name the axes of an ellipsoid x, y and z."""


def principal_axes(points: Array) -> tuple[Array, Array]:
    """Axes (3, 3) of points (N, 3), as columns, and the standard deviations (3,) along them.

    The axes are named so that their rotation is as small as possible.
    """
    variances, vectors = np.linalg.eigh(np.cov(points.T, bias=True))
    if np.linalg.det(vectors) < 0.0:
        vectors = -vectors
    turns = vectors @ _TURNS
    best = int(np.trace(turns, axis1=1, axis2=2).argmax())
    return turns[best], np.sqrt(variances @ np.abs(_TURNS[best]))
