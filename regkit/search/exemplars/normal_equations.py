"""Normal equations of a whole body from those of its segments, in compiled loops.

Loops take the place of NumPy's products and solver here: Numba compiles them in a small part of
the time.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from regkit.system.arrays import Array
from regkit.system.compiled import compiled


@compiled
def add_segments(
    matrix: Array,
    gradient: Array,
    jacobian: Array,
    dof_mask: Array,
    blocks: Array,
    gradients: Array,
) -> None:
    """Adds the lower triangle of J^T B J, and J^T g, of all segments.

    Args:
        matrix: Normal matrix, (n, n).
        gradient: Gradient, (n,).
        jacobian: Jacobian J of each segment's twist, (S, 6, n).
        dof_mask: 1 where a degree of freedom moves a segment, else 0, (n, S).
        blocks: Blocks B of the segments, (S, 6, 6).
        gradients: Their gradients g, (S, 6).
    """
    dofs, segments = dof_mask.shape
    for segment in range(segments):
        for row in range(dofs):
            if dof_mask[row, segment] == 0.0:
                continue
            for i in range(6):
                gradient[row] += jacobian[segment, i, row] * gradients[segment, i]
                loaded = 0.0
                for j in range(6):
                    loaded += jacobian[segment, j, row] * blocks[segment, j, i]
                for column in range(row + 1):
                    matrix[row, column] += loaded * jacobian[segment, i, column]


@compiled
def solve(matrix: Array, right: Array) -> None:
    """Solves A x = b in place by Cholesky's decomposition; ``right`` holds b before and x after.

    Args:
        matrix: A, of which only the lower triangle is read, (n, n); its factor is written there.
        right: b, (n,).

    Raises:
        LinAlgError: If A is not positive definite, or holds NaN.
    """
    count = len(right)
    for column in range(count):
        for row in range(column, count):
            entry = matrix[row, column]
            for k in range(column):
                entry -= matrix[row, k] * matrix[column, k]
            if row > column:
                matrix[row, column] = entry / matrix[column, column]
            elif entry > 0.0:
                matrix[row, column] = sqrt(entry)
            else:
                raise np.linalg.LinAlgError("the normal matrix is not positive definite")
        right[column] /= matrix[column, column]
        for row in range(column + 1, count):
            right[row] -= matrix[row, column] * right[column]
    for row in range(count - 1, -1, -1):
        right[row] /= matrix[row, row]
        for k in range(row):
            right[k] -= matrix[row, k] * right[row]
