"""How many distances are within a threshold, and the area under that curve."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array


def share_within(distances: Array, threshold: float, axis: int | None = None) -> Array:
    """How many of the known distances are below a threshold; NaN where none is known."""
    known = np.isfinite(distances).sum(axis=axis)
    below = (distances < threshold).sum(axis=axis)
    return np.asarray(np.where(known > 0, below / np.maximum(known, 1), np.nan))


def auc(distances: Array, widest: float) -> float | None:
    """The area under the curve of ``share_within`` from 0 to the widest threshold, from 0 to 1.

    It is exact: a distance d is within every threshold from d on, a part 1 - d / widest of them.
    None where no distance is known.
    """
    known = distances[np.isfinite(distances)]
    if not known.size:
        return None
    return float(np.maximum(1.0 - known / widest, 0.0).mean())
