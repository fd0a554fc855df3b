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
from regkit.system.arrays import Array

SURE_MARGIN = 0.1
"""A start is doubtful if another pose, turned or mirrored, costs only this much more.

Of 144 right starts of people (development set of ``benchmarks/starts.py``) none has a margin below
0.2.
"""

SURE_PLANAR, LOST_PLANAR = 0.1, 0.2
"""Data of which this much more lies on two planes than of the body's surface beside them are
doubtful, or no body but furniture.

Of 25 people it is at most 0.05 more, of 21 boxes at least 0.05 and in the median 0.23 (development
set of ``benchmarks/starts.py``).
"""

LOOSE = 0.15
"""A body fits loosely with a misfit that is larger by this than the data's noise, in limb radii."""

LOOSE_PLANAR, LOOSE_FLAT = 0.05, 0.45
"""Bounds of the share on planes and of the relief of data that a body fits loosely, as furniture.

They doubt 1 of 79 people, none of 59 folded ones and none of 51 hands that are right, and the two
of 160 frames of empty rooms and boxes that would else be found (development set of
``benchmarks/starts.py``).
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
    fit = BodyFit.of(body, pose, observation.points, observation.sight)
    shares = (fit.inlier_share, fit.coverage, fit.misfit, fit.relief)
    (verdict,) = frame_verdicts(np.ones(1), *(np.array([share]) for share in shares))
    loose = fit.misfit > LOOSE + float(np.sqrt(np.median(observation.variances))) / body.limb_radius
    reasons = [*_misfits(fit, LOOSE_FLAT if loose else FLAT), *doubts]
    excess = _planar_excess(body, pose, observation.points)
    if excess > (LOOSE_PLANAR if loose else SURE_PLANAR):
        reasons.append("the points lie on two planes, as those of furniture do")
        verdict = Verdict.LOST if excess > LOST_PLANAR else verdict
    if margin < SURE_MARGIN:
        reasons.append("another pose, turned or mirrored, fits nearly as well")
    inside = _share_inside(body, pose, observation)
    if inside < LEAST_SEEN:
        reasons.append(f"only {100.0 * inside:.0f} % of the body is in the picture")
    if reasons and verdict is Verdict.FOUND:
        verdict = Verdict.DOUBTFUL
    return Start(body, pose, verdict, "; ".join(reasons), margin)


def _misfits(fit: BodyFit, flat: float) -> list[str]:
    """Returns in words where the data and the body differ, and whether the data are flat."""
    told = []
    if fit.inlier_share < SURE_INLIERS:
        told.append(f"{100.0 * fit.inlier_share:.0f} % of the points lie on the body")
    if fit.coverage < SURE_COVERAGE:
        told.append(f"{100.0 * fit.coverage:.0f} % of the visible body has data")
    if fit.misfit > SURE_MISFIT:
        told.append(f"the data and the body are {fit.misfit:.2g} limb radii apart")
    if fit.relief < flat:
        told.append(f"the data are {'' if fit.relief < FLAT else 'nearly '}as flat as a wall")
    return told


def _planar_excess(body: Body, pose: Pose, points: Array) -> float:
    """Returns how much more of the points lies on two planes than of the surface beside them."""
    if not len(body.capsules):
        return 0.0
    placed = body.capsules.place(body.place(pose).transforms)
    _, distances, directions = placed.nearest(points)
    tolerance = SMOOTH * body.limb_radius
    surface = points - distances[:, None] * directions
    return planar_share(points, tolerance) - planar_share(surface, tolerance)


def _share_inside(body: Body, pose: Pose, observation: Observation) -> float:
    """Returns the fraction of the body that is inside the picture."""
    if observation.sight is None or not len(body.capsules):
        return 1.0
    capsules = body.capsules.place(body.place(pose).transforms)
    points = capsules.axis_points(SPACING * body.size).points
    return float(observation.sight.observable(points).mean())
