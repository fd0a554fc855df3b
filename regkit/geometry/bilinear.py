"""Quaternion operations as matrix products with constant tables.

Functions that are bilinear in two quaternions are linear in the products of their components. NumPy
has an overhead of about a microsecond per operation, so one matrix product with a constant table is
several times as fast as the written-out formula.
"""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array

_X, _Y, _Z, _W = range(4)
_CYCLES = ((_X, _Y, _Z), (_Y, _Z, _X), (_Z, _X, _Y))
_SIGNS = np.array([[1, -1, -1, 1], [-1, 1, -1, 1], [-1, -1, 1, 1]])
"""Signs of x^2, y^2, z^2 and w^2 in the diagonal entries of a rotation matrix, (3, 4)."""


def hamilton() -> Array:
    """Returns the table (16, 4) of the Hamilton product: ``(p q^T).ravel() @ table = p * q``."""
    table = np.zeros((4, 4, 4))
    table[_W, _W, _W] = 1.0
    for a, b, c in _CYCLES:
        table[[a, _W, b], [_W, a, c], a] = 1.0
        table[c, b, a] = -1.0
        table[a, a, _W] = -1.0
    return table.reshape(16, 4)


def matrix_of_products() -> Array:
    """Returns the table (16, 9) from ``(q q^T).ravel()`` to the flattened rotation matrix."""
    table = np.zeros((4, 4, 3, 3))
    for a, b, c in _CYCLES:
        table[range(4), range(4), a, a] = _SIGNS[a]
        table[a, b, [a, b], [b, a]] = 2.0
        table[c, _W, [b, a], [a, b]] = 2.0, -2.0
    return table.reshape(16, 9)


def products_of_matrix() -> Array:
    """Returns the table (9, 16) from a flattened rotation matrix to flattened ``4 q q^T - I``."""
    table = np.zeros((3, 3, 4, 4))
    for a, b, c in _CYCLES:
        table[a, a, range(4), range(4)] = _SIGNS[a]
        for first, second in ((a, b), (b, a)):
            table[[a, b], [b, a], first, second] = 1.0
        for first, second in ((c, _W), (_W, c)):
            table[[b, a], [a, b], first, second] = 1.0, -1.0
    return table.reshape(9, 16)
