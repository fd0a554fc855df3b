"""Starts where a pose contradicts the landmarks: of one limb, or of the whole body."""

from __future__ import annotations

import numpy as np

from regkit.registration.landmarks.table import SEGMENT
from regkit.search.landmark_fit import LandmarkFit
from regkit.search.limb_search import LimbSearch
from regkit.skeleton import Pose

FAR = 4.0
"""A marker farther than this from its landmark contradicts it, in units of the landmark's error:
12 cm of a person."""

MOST = 0.5
"""A body of which more than this share of the landmarks is contradicted is elsewhere."""

FEWEST = 2
"""A limb with fewer landmarks contradicts none: one may be an outlier."""


def contradicted_limbs(
    fit: LandmarkFit, searches: tuple[LimbSearch, ...], pose: Pose
) -> list[LimbSearch]:
    """Returns the limbs of which all landmarks, at least ``FEWEST``, are far from their markers."""
    far, segments = fit.sizes(pose) > FAR, fit.energy.table[:, SEGMENT]
    found = []
    for search in searches:
        own = far[np.isin(segments, search.limb.segments)]
        if len(own) >= FEWEST and own.all():
            found.append(search)
    return found


def contradicted(fit: LandmarkFit, pose: Pose) -> bool:
    """Returns whether most of the landmarks are far from their markers."""
    return bool((fit.sizes(pose) > FAR).mean() > MOST)


def body_starts(fit: LandmarkFit | None, pose: Pose) -> list[Pose]:
    """Returns poses of the whole body by its landmarks, if those contradict a pose."""
    if fit is None or not contradicted(fit, pose):
        return []
    best, *others = fit.turned(pose)
    return [best, *others[:1]]


def limb_starts(fit: LandmarkFit | None, search: LimbSearch, pose: Pose) -> list[Pose]:
    """Returns a pose whose limb is where its landmarks are, if all of those contradict a pose."""
    if fit is None or not contradicted_limbs(fit, (search,), pose):
        return []
    own = fit.of_segments(search.limb.segments)
    poses = search.limb.rotated(pose, search.balls, search.hinges)
    nearest = int(own.cost(poses).argmin())
    start = search.limb.rotated(pose, search.balls[nearest], search.hinges[nearest])
    return [fit.fitted(start, (4.0, 1.0))]
