"""The pose and size that bring the markers to their landmarks."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import scipy

from regkit.body import Body
from regkit.body.verdict import Verdict
from regkit.geometry.rigid import rigid
from regkit.interfaces import Start
from regkit.observation import Observation
from regkit.search.landmark_fit import LandmarkFit
from regkit.skeleton import Pose
from regkit.system.errors import DataError

FACING_CAMERA = np.diag([1.0, -1.0, -1.0])
"""R_camera_body of a body that faces the camera: its left on the image's right, its y up."""

FAR = 3.0
"""A marker farther than this from its landmark is an outlier, in units of the landmark's error."""

SURE = 0.7
"""A start with a smaller share of inliers is doubtful."""

REFINED = 12
"""Number of sizes that are tried between the candidates."""


def landmark_start(
    bodies: Callable[[float], Body], sizes: Sequence[float], seen: Observation
) -> Start:
    """Returns the start of least distance to the landmarks of a frame.

    Args:
        bodies: Function that returns the body of a size [m].
        sizes: Candidate sizes [m], ascending.
        seen: The frame.

    Raises:
        DataError: If the frame has no landmarks of the body's markers.
    """
    found = [_best(bodies(size), seen) for size in sizes]
    at = int(np.argmin([cost for cost, _ in found]))
    size, pose = sizes[at], found[at][1]
    if len(sizes) > 1:
        best = scipy.optimize.minimize_scalar(
            lambda tried: _near(bodies(tried), pose, seen)[0],
            bounds=(sizes[max(at - 1, 0)], sizes[min(at + 1, len(sizes) - 1)]),
            method="bounded",
            options={"maxiter": REFINED},
        )
        size = float(best.x)
        pose = _near(bodies(size), pose, seen)[1]
    body = bodies(size)
    share = float((_fit(body, seen).sizes(pose) <= FAR).mean())
    if share >= SURE:
        return Start(body, pose)
    reason = f"{100.0 * share:.0f} % of the landmarks are near their markers"
    return Start(body, pose, Verdict.DOUBTFUL, reason)


def _fit(body: Body, seen: Observation) -> LandmarkFit:
    fit = LandmarkFit.of(body, seen)
    if fit is None:
        known = () if seen.landmarks is None else seen.landmarks.names
        raise DataError(
            f"the first frame has no landmark of a marker of '{body.name}' (landmarks: "
            f"{', '.join(known) or 'none'}; markers: {', '.join(body.markers.names)})"
        )
    return fit


def _best(body: Body, seen: Observation) -> tuple[float, Pose]:
    """Returns cost and pose of the best stance."""
    fit, middle = _fit(body, seen), seen.points.mean(axis=0)
    found = []
    for stance in body.stances:
        root = stance.pose.root
        if body.skeleton.free:
            root = rigid(FACING_CAMERA @ root[:3, :3], middle)
        best = fit.turned(Pose(root, stance.pose.balls, stance.pose.hinges))[0]
        found.append((float(fit.cost(best)), best))
    return min(found, key=_cost)


def _near(body: Body, pose: Pose, seen: Observation) -> tuple[float, Pose]:
    """Returns cost and pose of a body of another size near a pose."""
    fit = _fit(body, seen)
    found = fit.fitted(pose, (4.0, 1.0))
    return float(fit.cost(found)), found


def _cost(found: tuple[float, Pose]) -> float:
    return found[0]
