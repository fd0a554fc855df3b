"""How well data support each segment of a posed body."""

from __future__ import annotations

import numpy as np

from regkit.body.body import Body
from regkit.system.arrays import Array

WEAK = 0.3
"""A segment with less support is hardly seen: its pose is a guess from its neighbours.

It was chosen by eye; no data have confirmed it.
"""


def segment_supports(body: Body, transforms: Array, points: Array) -> Array:
    """Returns the support of each segment, (S,), from 0 to 1; NaN for one without capsules.

    It is the fraction of the segment's axis beside which data lie on the segment's own surface,
    within the radius of a typical limb. A segment that is hidden, out of the picture or beside the
    data has none, and so has one that is stuck inside another.

    Args:
        body: The body.
        transforms: T_world_segment, (S, 4, 4).
        points: The data, (N, 3) [m].
    """
    count = len(transforms)
    if not len(body.capsules):
        return np.full(count, np.nan)
    axes = body.axes
    capsules = body.capsules.place(transforms)
    supported = capsules.supported(axes, points, body.limb_radius)
    samples = np.bincount(axes.segments, minlength=count)
    found = np.bincount(axes.segments, weights=supported, minlength=count)
    return np.where(samples > 0, found / np.maximum(samples, 1), np.nan)
