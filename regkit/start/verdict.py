"""The verdict of a start: both sides of the fit, the advantage over rivals, and the view."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from regkit.body import Body, BodyFit
from regkit.body.verdict import (
    FLAT,
    SURE_COVERAGE,
    SURE_INLIERS,
    SURE_MISFIT,
    Verdict,
    frame_verdicts,
)
from regkit.clouds import planar_share
from regkit.interfaces import Start
from regkit.observation import Observation
from regkit.skeleton import Pose

SURE_MARGIN = 0.1
"""A start is doubtful if another pose, turned or mirrored, costs only this much more.

Of 144 right starts of people (development set of ``benchmarks/starts.py``) none has a margin below
0.2.
"""

SURE_PLANAR, LOST_PLANAR = 0.7, 0.8
"""Data of which a larger fraction lies on two planes are doubtful, or no body but furniture.

Of people it is at most 0.66 (development set, and 77 frames of UTD-MHAD), of hands 0.68, and of
boxes at least 0.67, in the median 0.88.
"""

SMOOTH = 0.25
"""Distance within which a point lies on such a plane, in radii of a typical limb."""

SPACING = 0.05
"""Distance of the points that stand for a body, as a fraction of its size."""

LEAST_SEEN = 0.35
"""A start is doubtful if a smaller fraction of the body is inside the picture."""


def judged(
    body: Body,
    pose: Pose,
    observation: Observation,
    margin: float = np.nan,
    doubts: Sequence[str] = (),
) -> Start:
    """Returns a start with its verdict.

    Args:
        body: The body at its size.
        pose: Its pose.
        observation: The frame.
        margin: Cost of the best other pose less that of this one; NaN if there was none.
        doubts: More reasons for doubt.
    """
    fit = BodyFit.of(body, pose, observation.points, observation.silhouette)
    shares = (fit.inlier_share, fit.coverage, fit.misfit, fit.relief)
    (verdict,) = frame_verdicts(np.ones(1), *(np.array([share]) for share in shares))
    reasons = [*_misfits(fit), *doubts]
    planar = 0.0
    if len(body.capsules):
        planar = planar_share(observation.points, SMOOTH * body.required.limb_radius())
    if planar > SURE_PLANAR:
        reasons.append(f"{100.0 * planar:.0f} % of the points lie on two planes, as furniture's do")
        verdict = Verdict.LOST if planar > LOST_PLANAR else verdict
    if margin < SURE_MARGIN:
        reasons.append("another pose, turned or mirrored, fits nearly as well")
    inside = _share_inside(body, pose, observation)
    if inside < LEAST_SEEN:
        reasons.append(f"only {100.0 * inside:.0f} % of the body is in the picture")
    if reasons and verdict is Verdict.FOUND:
        verdict = Verdict.DOUBTFUL
    return Start(body, pose, verdict, "; ".join(reasons), margin)


def _misfits(fit: BodyFit) -> list[str]:
    """Returns in words where the data and the body differ."""
    told = []
    if fit.inlier_share < SURE_INLIERS:
        told.append(f"{100.0 * fit.inlier_share:.0f} % of the points lie on the body")
    if fit.coverage < SURE_COVERAGE:
        told.append(f"{100.0 * fit.coverage:.0f} % of the visible body has data")
    if fit.misfit > SURE_MISFIT:
        told.append(f"the data and the body are {fit.misfit:.2g} limb radii apart")
    if fit.relief < FLAT:
        told.append("the data are as flat as a wall")
    return told


def _share_inside(body: Body, pose: Pose, observation: Observation) -> float:
    """Returns the fraction of the body that is inside the picture."""
    if observation.silhouette is None or not len(body.capsules):
        return 1.0
    capsules = body.capsules.place(body.place(pose).transforms)
    points = capsules.axis_points(SPACING * body.size).points
    return float(observation.silhouette.observable(points).mean())
