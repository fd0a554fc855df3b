"""Several bodies beside each other in data: whose points are whose, and how well each fits them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from regkit.body.body import Body
from regkit.body.fit import FARTHEST, BodyFit, tolerance
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
    """Returns masks (N,) of each of several bodies' points: nearest to it, and not far away."""
    if not whole.free_bodies:
        return ()
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
    """Returns how well each of several bodies fits its own points; unknown if it is hidden.

    Args:
        whole: The bodies as one.
        pose: Its pose.
        points: The data, (N, 3) [m].
        sight: What the cameras show; None if everything is seen.
    """
    owned = points_of_each(whole, pose, points)
    return tuple(
        _fit(one.body, one.alone(pose), points[own], sight)
        for one, own in zip(whole.free_bodies, owned, strict=True)
    )


def _fit(body: Body, pose: Pose, points: Array, sight: Sight | None) -> BodyFit:
    """Returns the fit of a body to its points; the worst if there should be some."""
    if len(points):
        return BodyFit.of(body, pose, points, sight)
    if sight is not None and len(body.capsules):
        axes = body.required_axes
        spheres = axes.place(body.place(pose).transforms)
        if not sight.observable(spheres, axes.radii + body.limb_radius).any():
            return BodyFit.unknown()
    return BodyFit(np.inf, 0.0, 0.0, 2.0 * FARTHEST, 0.0)


def shares_of_each(fits: Sequence[BodyFit]) -> Array:
    """Returns inlier share, coverage, misfit and relief of several fits, (K, 4)."""
    rows = [(one.inlier_share, one.coverage, one.misfit, one.relief) for one in fits]
    return np.array(rows).reshape(-1, 4)


def verdicts_of_each(shares: Array) -> tuple[Verdict, ...]:
    """Returns the verdict of each of several bodies; one that is hidden has no data.

    Args:
        shares: What ``shares_of_each`` returns, (K, 4).
    """
    return tuple(
        Verdict.NO_DATA if np.isnan(row[0]) else frame_verdict(1, *row) for row in shares.tolist()
    )
