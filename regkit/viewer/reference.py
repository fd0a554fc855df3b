"""Reference joints in some frames of a recording."""

from __future__ import annotations

import numpy as np

from regkit.observation import Truth
from regkit.system.arrays import Array, Indices


def reference_of(truth: Truth | None, frames: Indices) -> tuple[tuple[str, ...], Array]:
    """Returns the names of J reference joints, and their positions in frames (F, J, 3) [m].

    Args:
        truth: The reference joints; None for none, J = 0.
        frames: Numbers of the frames, (F,); NaN stands for those that the reference lacks.
    """
    if truth is None:
        return (), np.zeros((len(frames), 0, 3))
    positions = np.full((len(frames), len(truth.joints), 3), np.nan)
    known = frames < len(truth.positions)
    positions[known] = truth.positions[frames[known]]
    return tuple(truth.joints), positions
