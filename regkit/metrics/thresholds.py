"""The fraction of distances within a threshold (PCK), and the area under its curve (AUC)."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array


def fraction_within(distances: Array, threshold: float, axis: int | None = None) -> Array:
    """Returns the fraction of finite distances below a threshold; NaN if none is finite.

    Args:
        distances: Distances of any shape [m]; NaN where unknown.
        threshold: The threshold [m].
        axis: Axis along which to count; all elements by default.
    """
    known = np.isfinite(distances).sum(axis=axis)
    below = (distances < threshold).sum(axis=axis)
    return np.asarray(np.where(known > 0, below / np.maximum(known, 1), np.nan))


def auc(distances: Array, largest: float) -> float | None:
    """Returns the area under the curve of ``fraction_within`` for thresholds from 0 to ``largest``.

    The area is normalised to [0, 1] and exact: a distance d is within all thresholds above d, which
    are a fraction 1 - d / largest of the range. Returns None if no distance is finite.
    """
    known = distances[np.isfinite(distances)]
    if not known.size:
        return None
    return float(np.maximum(1.0 - known / largest, 0.0).mean())
