"""Several bodies beside each other in data: whose points are whose, and how well each fits them."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from regkit.body.body import Body
from regkit.body.fit import BodyFit, tolerance
from regkit.body.gaps import surface_gaps
from regkit.body.verdict import Verdict, frame_verdict
from regkit.observation.sight import Sight
from regkit.skeleton import Pose
from regkit.system.arrays import Array

REACH = 0.5
"""Points farther from a body than this are not its points, in sizes of the body."""


def gaps_to_each(whole: Body, pose: Pose, points: Array) -> Array:
    """Returns the distances of points to each of several bodies, (K, N) [m].

    Args:
        whole: The bodies as one.
        pose: Its pose.
        points: The points, (N, 3) [m].
    """
    found = [surface_gaps(one.body, one.alone(pose), points) for one in whole.free_bodies]
    beyond = np.full(len(points), np.inf)
    return np.array([beyond if gaps is None else gaps for gaps in found])


def points_of_each(whole: Body, pose: Pose, points: Array) -> tuple[NDArray[np.bool_], ...]:
    """Returns masks (N,) of the points of each of several bodies: nearest to it, and not far."""
    gaps = gaps_to_each(whole, pose, points)
    nearest = gaps.argmin(axis=0)
    return tuple(
        (nearest == at) & (gaps[at] < REACH * one.body.size)
        for at, one in enumerate(whole.free_bodies)
    )


def unexplained_by_others(whole: Body, pose: Pose, points: Array, body: int) -> NDArray[np.bool_]:
    """Returns a mask of the points, (N,), that are on none of the bodies but possibly one.

    Args:
        whole: The bodies as one.
        pose: Its pose.
        points: The points, (N, 3) [m].
        body: Index of the one body among the others.
    """
    gaps = gaps_to_each(whole, pose, points)
    near = np.array([tolerance(one.body) for one in whole.free_bodies])
    taken = gaps <= near[:, None]
    taken[body] = False
    return np.asarray(~taken.any(axis=0))


def fits_of_each(
    whole: Body, pose: Pose, points: Array, sight: Sight | None
) -> tuple[BodyFit, ...]:
    """Returns how well each of several bodies fits its own points; unknown without a point.

    What another body hides of a body counts as hidden.

    Args:
        whole: The bodies as one.
        pose: Its pose.
        points: The data, (N, 3) [m].
        sight: What the cameras show; None if everything is seen.
    """
    owned = points_of_each(whole, pose, points)
    return tuple(
        BodyFit.of(one.body, one.alone(pose), points[own], sight)
        if own.any()
        else BodyFit.unknown()
        for one, own in zip(whole.free_bodies, owned, strict=True)
    )


def verdicts_of_each(fits: Iterable[BodyFit]) -> tuple[Verdict, ...]:
    """Returns the verdict of each of several bodies by its fit; lost if it has no points."""
    shares = [(one.inlier_share, one.coverage, one.misfit, one.relief) for one in fits]
    return tuple(
        Verdict.LOST if np.isnan(inliers) else frame_verdict(1, inliers, *others)
        for inliers, *others in shares
    )
