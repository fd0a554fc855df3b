"""Starts where a pose contradicts the landmarks: of one limb, or of the whole body."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from regkit.search.landmark_fit import SCALES, LandmarkFit
from regkit.search.limb_search import LimbSearch
from regkit.skeleton import Pose

FAR = 3.0
"""A marker farther than this from its landmark contradicts it, in units of the landmark's error:
9 cm of a person."""

MOST = 0.5
"""A body of which more than this share of the landmarks is contradicted is elsewhere."""

FEWEST = 2
"""Number of contradicted landmarks of a limb that is elsewhere: one may be an outlier."""

GAIN = 7.0
"""Least decrease of the landmarks' robust cost by the best sampled configuration of a limb, and by
its fit: an outlier costs 7.

With 3, some wrong limbs are found earlier, and outliers may move right ones. Chosen on the
sequences of ``benchmarks/keypoints.py --develop``.
"""


def body_starts(fit: LandmarkFit, pose: Pose) -> list[Pose]:
    """Returns poses of the whole body by its landmarks, if those contradict a pose.

    Landmarks in the picture do not tell front from back, so there are several.
    """
    if (fit.sizes(pose) > FAR).mean() <= MOST:
        return []
    return fit.turned(pose)


def contradicted_limbs(
    fit: LandmarkFit, searches: Iterable[LimbSearch], pose: Pose
) -> list[LimbSearch]:
    """Returns the limbs of which ``FEWEST`` landmarks or more contradict a pose."""
    far = fit.energy.segments[fit.sizes(pose) > FAR]
    return [one for one in searches if np.isin(far, one.limb.segments).sum() >= FEWEST]


def limb_starts(fit: LandmarkFit, search: LimbSearch, pose: Pose) -> list[Pose]:
    """Returns a pose whose limb is where its landmarks are, if that costs clearly less."""
    own = fit.of_segments(search.limb.segments)
    costs = own.cost(search.limb.rotated(pose, search.balls, search.hinges))
    best = int(costs.argmin())
    if costs[best] > own.cost(pose) - GAIN:
        return []
    start = search.limb.rotated(pose, search.balls[best], search.hinges[best])
    fitted = fit.fitted(start, SCALES[1:])
    return [fitted] if fit.cost(fitted) < fit.cost(pose) - GAIN else []
