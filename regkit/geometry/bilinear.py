"""Quaternion algebra as tables: what is bilinear in quaternions is one small matrix product.

NumPy needs a microsecond or more for each operation on a few numbers, so that one product with a
table is several times as fast as the formulas written out.
"""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array

_X, _Y, _Z, _W = range(4)
_CYCLES = ((_X, _Y, _Z), (_Y, _Z, _X), (_Z, _X, _Y))
_SIGNS = np.array([[1, -1, -1, 1], [-1, 1, -1, 1], [-1, -1, 1, 1]])
"""Of x^2, y^2, z^2 and w^2 in the diagonal of a rotation matrix."""


def hamilton() -> Array:
    """From the flattened products of two quaternions' numbers to their product, (16, 4)."""
    table = np.zeros((4, 4, 4))
    table[_W, _W, _W] = 1.0
    for a, b, c in _CYCLES:
        table[[a, _W, b], [_W, a, c], a] = 1.0
        table[c, b, a] = -1.0
        table[a, a, _W] = -1.0
    return table.reshape(16, 4)


def matrix_of_products() -> Array:
    """From the flattened products q q^T of a unit quaternion to its flattened matrix, (16, 9)."""
    table = np.zeros((4, 4, 3, 3))
    for a, b, c in _CYCLES:
        table[range(4), range(4), a, a] = _SIGNS[a]
        table[a, b, [a, b], [b, a]] = 2.0
        table[c, _W, [b, a], [a, b]] = 2.0, -2.0
    return table.reshape(16, 9)


def products_of_matrix() -> Array:
    """From a flattened rotation matrix to 4 q q^T less the identity, flattened, (9, 16)."""
    table = np.zeros((3, 3, 4, 4))
    for a, b, c in _CYCLES:
        table[a, a, range(4), range(4)] = _SIGNS[a]
        for first, second in ((a, b), (b, a)):
            table[[a, b], [b, a], first, second] = 1.0
        for first, second in ((c, _W), (_W, c)):
            table[[b, a], [a, b], first, second] = 1.0, -1.0
    return table.reshape(9, 16)
