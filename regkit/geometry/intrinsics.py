"""The matrix K of a pinhole camera, by rows or by columns."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from regkit.system.errors import DataError

MAX_SKEW = 1e-6
"""Largest skew, as a fraction of the focal length, that counts as rounding."""


def intrinsics_of(values: ArrayLike) -> tuple[float, float, float, float]:
    """Returns fx, fy, cx and cy [px] of a camera's matrix K.

    Where 0 0 1 stands says how the matrix is written: as its last row, as in most libraries, or as
    its last column, as in Open3D's files.

    Args:
        values: 9 numbers, flat or as (3, 3).

    Raises:
        DataError: If it is no such matrix, or has skew.
    """
    given = np.array(values)
    if given.dtype.kind not in "iuf" or given.shape not in ((9,), (3, 3)):
        raise DataError(
            f"the matrix must be 9 numbers, flat or as 3x3; it is {given.dtype} of the shape "
            f"{given.shape}"
        )
    matrix = given.astype(np.float64).reshape(3, 3)
    if (matrix[2] != [0.0, 0.0, 1.0]).any():
        if (matrix[:, 2] != [0.0, 0.0, 1.0]).any():
            raise DataError(
                f"the matrix {matrix.tolist()} has 0 0 1 neither as its last row nor as its last "
                "column; it must be K = [[fx, 0, cx], [0, fy, cy], [0, 0, 1]], by rows or by "
                "columns"
            )
        matrix = matrix.T
    (fx, skew, cx), (shear, fy, cy) = matrix[:2].tolist()
    if max(abs(skew), abs(shear)) > MAX_SKEW * abs(fx):
        raise DataError(
            f"the matrix {matrix.tolist()} has skew; regkit's cameras have none: rectify the images"
        )
    return fx, fy, cx, cy
