"""Registration of a candidate: of the parts that overlap, if its accuracy is known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from regkit.alignment.contest import Contestant
from regkit.body.cloud import cloud_body
from regkit.clouds import spacing
from regkit.clouds.agreement import Agreements
from regkit.geometry.rigid import inverse, transformed
from regkit.interfaces import AlignmentCandidate, Evaluation, Method, RegistrationResult
from regkit.observation import Observation
from regkit.system.arrays import Array

FEWEST = 50
"""Least number of points of each part; fewer do not determine a pose, and the clouds are whole."""


def registered(
    candidate: AlignmentCandidate, clouds: Agreements, method: Method
) -> tuple[Array, RegistrationResult]:
    """Returns T_target_source (4, 4) after the registration of a candidate, and its result.

    What has nothing to overlap with would only pull at the edges of the other cloud: on views 48
    and 96 degrees apart, leaving it out halves the rotation error. So the points that are farther
    from the other cloud than the candidate is off are left out.

    Args:
        candidate: The candidate.
        clouds: The clouds.
        method: The registration method.
    """
    source, target = clouds.source.points, clouds.target.points
    if np.isfinite(candidate.accuracy):
        source, target = _parts(candidate, clouds)
    # With the origin at the centroids, rotation and translation are decoupled, and numbers are
    # small: coordinates of maps, of millions of metres, would cost half of their digits.
    centre, origin = source.mean(axis=0), target.mean(axis=0)
    body = cloud_body("source", source - centre)
    start = body.skeleton.rest(shifted(candidate.transform, -origin, centre))
    data = _data(target - origin)
    (result,) = method.bind(body).register_each(data, [start], accuracy=candidate.accuracy)
    if result.deformation is not None:
        result = replace(result, deformation=result.deformation.shifted(origin))
    return shifted(result.pose.root, origin, -centre), result


def registered_whole(best: Contestant, clouds: Agreements, method: Method) -> Contestant:
    """Returns a contestant registered once more, with the points that overlap with nothing.

    A deformation is fitted to all points, because those beyond the other cloud move along.

    Args:
        best: The contestant.
        clouds: The clouds.
        method: The registration method.
    """
    again = replace(best.candidate, transform=best.transform, accuracy=np.inf)
    transform, result = registered(again, clouds, method)
    agreement = clouds.after(transform, best.agreement.distance)
    return replace(best, transform=transform, result=result, agreement=agreement)


def evaluated(transform: Array, clouds: Agreements, method: Method) -> Evaluation:
    """Returns the method's quality of T_target_source (4, 4) on the whole clouds."""
    source, target = clouds.source.points, clouds.target.points
    centre, origin = source.mean(axis=0), target.mean(axis=0)
    body = cloud_body("source", source - centre)
    pose = body.skeleton.rest(shifted(transform, -origin, centre))
    return method.bind(body).evaluate(_data(target - origin), pose)


def shifted(transform: Array, origin: Array, centre: Array) -> Array:
    """Returns T (4, 4) with a shift by ``centre`` (3,) [m] before it and ``origin`` (3,) after."""
    moved = transform.copy()
    moved[:3, 3] = transform[:3, 3] + (transform[:3, :3] @ centre + origin)
    return moved


def _parts(candidate: AlignmentCandidate, clouds: Agreements) -> tuple[Array, Array]:
    """Returns the points of both clouds that are near the other one, or all if they are few."""
    source, target, within = clouds.source.points, clouds.target.points, candidate.accuracy
    moved = transformed(candidate.transform, source)
    back = transformed(inverse(candidate.transform), target)
    on_target = np.isfinite(clouds.target.nearest(moved, 1, within)[0][:, 0])
    on_source = np.isfinite(clouds.source.nearest(back, 1, within)[0][:, 0])
    if min(on_target.sum(), on_source.sum()) < FEWEST:
        return source, target
    return source[on_target], target[on_source]


def _data(points: Array) -> Observation:
    return Observation(points, np.ones(len(points)), np.full(len(points), spacing(points) ** 2))
